#pragma once

namespace lamella {

/// From here on Ctrl-C, SIGTERM and a closed terminal set a flag; a second one of these ends the
/// program as usual. Signals that the program was started to ignore (nohup) stay ignored. A reader
/// of standard output that goes away no longer ends the program. SIGUSR1 asks for a checkpoint.
void watch_for_interrupt();
bool interrupt_requested();
/// SIGUSR1 came since this was asked last.
bool checkpoint_requested();

} // namespace lamella
