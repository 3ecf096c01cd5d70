// Replaces device nodes by emulated boards: open, ioctl and close of this process go to a board for registered paths,
// and to the system for all others.
//
// The handle is the write end of a pipe. Full: nothing to reap. Drained: poll reports writable, as for a real node with
// completed URBs. Reader closed: poll reports an error, as for a device that is gone.
#pragma once

#include "tests/devices/usb/emulation/usbfs_board.h"

#include <string>

namespace tangent::emulation {

/// `board` serves opens of `path` until detached. `open_error`: if not 0, errno that opening fails with.
void attach_board(const std::string& path, UsbfsBoard& board, int open_error = 0);
/// The node goes away: handles see an error, opens fail with ENODEV.
void detach_board(const std::string& path);

}  // namespace tangent::emulation
