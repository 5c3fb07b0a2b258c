#pragma once

// Embree, whichever is installed: 3 has streams of rays, 4 has packets alone. For sources of this
// folder; no header that others include shows it.
#if __has_include(<embree3/rtcore.h>)
#include <embree3/rtcore.h>
#else
#include <embree4/rtcore.h>
#endif
