// lamella: dynamics of lipid vesicles on the command line.
#include "cancellation.h"
#include "command_line.h"
#include "error.h"
#include "exit_code.h"
#include "interrupt.h"
#include "progress.h"
#include "render/render.h"
#include "usage_error.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <new>
#include <string>
#include <unistd.h>

namespace {

using namespace lamella;

/// One line, whatever is in the message; cannot fail.
int complain(int code, std::string message) {
  for (char& c : message)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  std::fprintf(stderr, "lamella: %s\n", message.c_str());
  return code;
}

int obey(int argc, char** argv) {
  try {
    return parse_command_line(argc, argv)();
  } catch (const UsageError& e) {
    return complain(bad_input, e.what());
  } catch (const SceneError& e) {
    return complain(bad_input, e.what());
  } catch (const StoreError& e) {
    return complain(cannot_store, e.what());
  } catch (const RenderError& e) {
    return complain(no_pictures, e.what());
  } catch (const Cancelled&) {
    return complain(interrupted, "interrupted");
  } catch (const std::filesystem::filesystem_error& e) {
    return complain(cannot_store, fmt::format("{}: {}", e.path1().string(), e.code().message()));
  } catch (const std::bad_alloc&) {
    return complain(run_stopped, "not enough memory");
  } catch (const std::exception& e) {
    return complain(unexpected, std::string("unexpected error, please report it: ") + e.what());
  } catch (...) {
    return complain(unexpected, "unexpected error of an unknown kind, please report it");
  }
}

/// Where one is closed, a file of the run would take its place and receive what is said.
void open_standard_streams() {
  int descriptor = 0;
  while (descriptor >= 0 && descriptor <= STDERR_FILENO) descriptor = open("/dev/null", O_RDWR);
  if (descriptor >= 0) close(descriptor);
}

} // namespace

int main(int argc, char** argv) {
  watch_for_interrupt(); // before all else: nothing may be cut short without a word
  open_standard_streams();
  const int code = obey(argc, argv), unsaid = why_unsaid();
  if (unsaid != 0 && unsaid != EPIPE && code == success)
    return complain(cannot_store, fmt::format("standard output: {}", std::strerror(unsaid)));
  return code;
}
