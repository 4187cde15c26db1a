#pragma once
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <pty.h>
#include <string>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>
#include <vector>

namespace lamella {

inline std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// What the program left behind.
struct Result {
  int code = -1;        ///< minus the signal that ended it
  std::string out, err; ///< standard output and error
};

/// The circumstances of a call.
struct Setting {
  std::filesystem::path folder;               ///< to run in; output files appear beside it
  rlim_t largest_file = RLIM_INFINITY;        ///< bytes
  bool without_privileges = false;            ///< root becomes nobody
  std::vector<int> ignored = {};              ///< signals, as by nohup and for background jobs
  bool closed_output = false;                 ///< no standard output at all
  bool no_reader = false;                     ///< standard output is a pipe that nobody reads
  std::filesystem::path standard_output = {}; ///< a file to use instead
  std::vector<std::pair<std::string, std::string>> environment = {}; ///< variables to set
};

/// The program as a child process.
class Program {
public:
  Program(const std::vector<std::string>& arguments, const Setting& setting)
      : out_(setting.folder.string() + ".out"), err_(setting.folder.string() + ".err") {
    if (!setting.standard_output.empty()) out_ = setting.standard_output;
    id_ = fork();
    if (id_ != 0) return;
    redirect(out_, STDOUT_FILENO);
    redirect(err_, STDERR_FILENO);
    if (setting.closed_output) close(STDOUT_FILENO);
    if (int ends[2]; setting.no_reader && pipe(ends) == 0) {
      dup2(ends[1], STDOUT_FILENO);
      close(ends[0]);
      close(ends[1]);
    }
    const rlimit limit{setting.largest_file, setting.largest_file};
    setrlimit(RLIMIT_FSIZE, &limit);
    for (const int signal : setting.ignored) std::signal(signal, SIG_IGN);
    execute(arguments, setting);
  }

  void interrupt() const { signal(SIGINT); }
  void signal(int number) const { kill(id_, number); }

  void wait_until_stopped() const {
    int status = 0;
    waitpid(id_, &status, WUNTRACED);
  }

  Result wait() const {
    int status = 0;
    waitpid(id_, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status),
            out_ == "/dev/full" ? "" : text_of(out_), text_of(err_)};
  }

  /// Containers may lack /dev/pts.
  static bool has_terminals() {
    int terminal = -1, other = -1;
    if (openpty(&terminal, &other, nullptr, nullptr, nullptr) != 0) return false;
    close(terminal);
    close(other);
    return true;
  }

  /// Everything it writes to a terminal so many columns wide.
  static std::string on_terminal(unsigned short columns, const std::vector<std::string>& arguments,
                                 const Setting& setting) {
    winsize size{24, columns, 0, 0};
    int terminal = -1;
    const pid_t id = forkpty(&terminal, nullptr, nullptr, &size);
    if (id == 0) execute(arguments, setting);
    std::string all(1 << 20, '\0');
    std::size_t count = 0;
    for (ssize_t n = 1; n > 0 && count<all.size(); count += n> 0 ? n : 0)
      n = read(terminal, all.data() + count, all.size() - count);
    waitpid(id, nullptr, 0);
    close(terminal);
    all.resize(count);
    return all;
  }

private:
  static void redirect(const std::filesystem::path& file, int descriptor) {
    dup2(open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666), descriptor);
  }

  [[noreturn]] static void execute(std::vector<std::string> arguments, const Setting& setting) {
    constexpr uid_t nobody = 65534;
    if (setting.without_privileges && geteuid() == 0 && setuid(nobody) != 0) _exit(126);
    if (chdir(setting.folder.c_str()) != 0) _exit(126);
    arguments.insert(arguments.begin(), LAMELLA_PROGRAM);
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    unsetenv("DISPLAY");
    setenv("LC_ALL", "C", 1); // the least that a system offers
    for (const auto& [name, value] : setting.environment) setenv(name.c_str(), value.c_str(), 1);
    execv(argv[0], argv.data());
    _exit(127);
  }

  std::filesystem::path out_, err_;
  pid_t id_ = -1;
};

} // namespace lamella
