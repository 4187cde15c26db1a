#pragma once

namespace lamella {

/// What the program returns to the shell.
enum ExitCode {
  success = 0,
  unexpected = 1,    ///< a mistake of the program itself
  bad_input = 2,     ///< command line or scene; nothing was written
  run_stopped = 3,   ///< the run could not go on; the last good state is stored
  cannot_store = 4,  ///< a file could not be written or read
  no_pictures = 5,   ///< the run is complete, its pictures could not be drawn
  resumable = 75,    ///< a run was interrupted; `lamella run --resume` goes on
  interrupted = 130, ///< Ctrl-C or SIGTERM; there is nothing to resume
};

} // namespace lamella
