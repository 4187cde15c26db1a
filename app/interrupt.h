#pragma once

namespace lamella {

/// From here on Ctrl-C and SIGTERM set a flag, once; a second one ends the program as usual.
void watch_for_interrupt();
bool interrupt_requested();

} // namespace lamella
