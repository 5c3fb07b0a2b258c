#pragma once

#include <string>

// 70 x 66 pixels in tiles, with or without mip-maps; `odd` is added to the last value of the full
// size, the smaller levels hold one value.
void write_tiled(const std::string& name, bool has_levels, float odd, float odd_in_level);

// Deep scan lines.
void write_deep(const std::string& name);

// Two parts with data windows of their own; `last` is the last value of the second.
void write_windows(const std::string& name, float last);

// The same picture as JPEG and as Radiance HDR (rows below 8 pixels are not run-length coded);
// `odd` is added to one value.
void write_jpeg(const std::string& name, int quality, int odd);
void write_radiance(const std::string& name, int width, float odd);
