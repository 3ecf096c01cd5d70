// Puts emulated boards in the place of device nodes: open, ioctl and close of this process go to a board where the
// path is one that was registered, and to the system everywhere else.
//
// The handle is the write end of a pipe. Full: nothing to reap. Drained: poll says writable, as for a real node with
// completed URBs. Its reader closed: poll says error, as for a device that is gone.
#pragma once

#include "tests/devices/usb/emulation/usbfs_board.h"

#include <string>

namespace tangent::emulation {

/// `board` serves opens of `path` until it is withdrawn. `open_error`: errno that opening meets instead.
void attach_board(const std::string& path, UsbfsBoard& board, int open_error = 0);
/// The node goes away: handles see an error, opens fail with ENODEV.
void detach_board(const std::string& path);

}  // namespace tangent::emulation
