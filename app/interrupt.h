#pragma once

namespace lamella {

/// From here on SIGINT (Ctrl-C), SIGTERM, SIGHUP (a closed terminal), SIGUSR2 and SIGXCPU (job
/// managers, before they kill) set a flag; a Ctrl-C after that ends the program at once, the others
/// come in numbers. SIGUSR1 asks for a checkpoint. Signals that the program was started to ignore
/// (nohup) stay ignored. Neither a reader of standard output that goes away nor a file beyond the
/// allowed size ends the program: both become errors.
void watch_for_interrupt();
bool interrupt_requested();
/// SIGUSR1 came since this was asked last.
bool checkpoint_requested();

/// For commands that have nothing to store: all of these but SIGUSR1 end the program from here on,
/// one that has come already does so now, and so does a reader that goes away.
void end_at_interrupt();

} // namespace lamella
