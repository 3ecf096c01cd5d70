#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>

#if defined(__SANITIZE_THREAD__)
// Embree builds its trees on TBB's worker threads. Neither library is built with the sanitizer, which then sees none
// of their synchronisation; reports that involve them are left out. The threads of this program are all watched.
extern "C" const char* __tsan_default_suppressions();
extern "C" const char* __tsan_default_suppressions() { return "race:libtbb.so\nrace:libembree3.so\n"; }
#endif
