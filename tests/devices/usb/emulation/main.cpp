// The tests of the USB devices need umockdev's library, and the shim, in front of everything. The program starts itself
// again with them.
#include <doctest/doctest.h>

#include <cstdlib>
#include <string>

#include <unistd.h>

int main(int argc, char** argv) {
  if (std::getenv("TANGENT_USB_TEST") == nullptr) {
    setenv("TANGENT_USB_TEST", "1", 1);
    std::string first;
#if defined(__SANITIZE_ADDRESS__)
    first = TANGENT_LIBASAN ":";
#elif defined(__SANITIZE_THREAD__)
    first = TANGENT_LIBTSAN ":";
#endif
    setenv("LD_PRELOAD", (first + TANGENT_USBFS_SHIM ":libumockdev-preload.so.0").c_str(), 1);
    execv("/proc/self/exe", argv);
    return 1;
  }
  return doctest::Context(argc, argv).run();
}
