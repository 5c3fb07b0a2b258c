#include "raster/bins.h"

#include <algorithm>

namespace penumbra::raster {

void BinningScratch::reset(int bin_count) {
    counts_.assign(static_cast<std::size_t>(bin_count), 0);
    entries_.clear();
    touched_.clear();
}

void BinningScratch::add(int bin, std::uint32_t triangle) {
    entries_.push_back({bin, triangle});
    if (counts_[bin]++ == 0) touched_.push_back(bin);
}

void BinningScratch::finish(Chunk& chunk) {
    std::sort(touched_.begin(), touched_.end());
    chunk.parts.clear();
    std::uint32_t begin = 0;
    for (const int bin : touched_) {
        const std::uint32_t count = counts_[bin];
        chunk.parts.push_back({bin, begin, count});
        counts_[bin] = begin;  // from here on: where the bin's next reference goes
        begin += count;
    }
    chunk.references.resize(entries_.size());
    for (const Entry& entry : entries_) chunk.references[counts_[entry.bin]++] = entry.triangle;
    for (const int bin : touched_) counts_[bin] = 0;
    entries_.clear();
    touched_.clear();
}

std::size_t BinningScratch::allocated_bytes() const {
    return entries_.capacity() * sizeof(Entry) + counts_.capacity() * sizeof(std::uint32_t) +
           touched_.capacity() * sizeof(int);
}

void collect(std::span<const Chunk> chunks, const BinGrid& grid, Bins& bins) {
    bins.grid = grid;
    bins.first.assign(static_cast<std::size_t>(grid.bin_count()) + 1, 0);
    for (const Chunk& chunk : chunks)
        for (const Chunk::Part& part : chunk.parts) ++bins.first[part.bin + 1];
    for (std::size_t k = 1; k < bins.first.size(); ++k) bins.first[k] += bins.first[k - 1];

    bins.parts.resize(bins.first.back());
    std::vector<std::size_t> next(bins.first.begin(), bins.first.end() - 1);
    for (std::size_t k = 0; k < chunks.size(); ++k)
        for (const Chunk::Part& part : chunks[k].parts)
            bins.parts[next[part.bin]++] = {static_cast<int>(k), part.begin, part.count};
}

}  // namespace penumbra::raster
