// For threads that solve beside the servo and the window.
#pragma once

namespace tangent {

/// The calling thread, and those that it starts from now on, yield to servo and window. (On Linux niceness is a
/// thread's own; elsewhere nothing happens.)
void yield_to_servo_and_window();

/// Threads for work in the background: one core stays free for the servo, up to four are used.
unsigned background_threads();

}  // namespace tangent
