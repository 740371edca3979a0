// How often the exact stages of the predicates are reached: counted by the campaigns in
// trust/, which compile the core with ALPHAMESH_COUNT; otherwise nothing.
#pragma once

#ifdef ALPHAMESH_COUNT
#include <cstdint>

namespace alphamesh::counting {
inline std::uint64_t calls = 0;       // the filter has left it open
inline std::uint64_t expansions = 0;  // so has double-double
}  // namespace alphamesh::counting

#define ALPHAMESH_NOTE(what) (++::alphamesh::counting::what)
#else
#define ALPHAMESH_NOTE(what) static_cast<void>(0)
#endif
