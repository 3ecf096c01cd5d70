// The safety gate and the devices in a program of your own, beside <tangent/tangent.h>. Link tangent::devices.
//
// The gate stands between a tick's force and every device, simulated ones included: before_sending before the exchange
// with the device, pass after the tick (safety_gate.h). It takes no clock of its own.
#pragma once

#include "devices/device_safety.h"
#include "devices/device_set.h"
#include "devices/safety_gate.h"
#include "devices/simulated_hand.h"
