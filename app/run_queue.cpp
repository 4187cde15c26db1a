#include "run_queue.h"

#include "error.h"
#include "interrupt.h"
#include "progress.h"
#include "render/qt_session.h"
#include "run_contents.h"

#include <QCoreApplication>
#include <QEventLoop>
#include <QProcess>
#include <QTimer>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fstream>
#include <memory>
#include <unistd.h>

namespace lamella {

namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;

/// In arbitrary units; two phases cost ten times as much, as measured over the built-in scenes.
double cost_of(const Scene& scene) {
  return double(scene.grid().size()) * std::pow(scene.numerics.tolerance, -0.35) *
         (scene.has_phases() ? 10 : 1);
}

/// The time of the last whole row of a history; 0 where there is none.
double last_time(const fs::path& history) {
  std::ifstream stream(history, std::ios::binary | std::ios::ate);
  constexpr std::streamoff tail = 4096;
  stream.seekg(std::max<std::streamoff>(0, std::streamoff(stream.tellg()) - tail));
  double time = 0;
  for (std::string line; std::getline(stream, line) && !stream.eof();)
    if (char* end = nullptr; std::strtod(line.c_str(), &end) >= 0 && *end == ',')
      time = std::strtod(line.c_str(), nullptr);
  return time;
}

/// A share from 0 to 1: steps grow with time at first and are equal later.
double share_done(double time, double end) {
  if (time <= 0) return 0;
  const double early = std::clamp(1 + std::log10(time / end) / 5, 0.0, 1.0);
  return 0.5 * early + 0.5 * std::min(time / end, 1.0);
}

/// The last line of what a process said.
std::string last_line(const QByteArray& text) {
  const QString line = QString::fromUtf8(text).trimmed().section('\n', -1);
  return line.startsWith("lamella: ") ? line.mid(9).toStdString() : line.toStdString();
}

/// Why a process did not do what it should.
std::string reason(QProcess& process, const fs::path& folder) {
  if (process.error() == QProcess::FailedToStart) return "could not be started";
  const std::string said = last_line(process.readAllStandardError());
  if (!said.empty()) return said;
  if (process.exitStatus() == QProcess::CrashExit) return "was killed, or crashed";
  return fmt::format("could not go on (exit code {}), see {}", process.exitCode(),
                     (folder / "summary.txt").string());
}

/// One run on its way.
struct Job {
  Job() = default;
  Job(const Job&) = delete;
  void operator=(const Job&) = delete;
  ~Job() { process->deleteLater(); }

  Scene scene;
  RunStore::Order order;
  QProcess* process = new QProcess; ///< deletes itself when Qt comes by again
  Clock::time_point begin = Clock::now();

  double share() const { return share_done(last_time(order.folder / "history.csv"), scene.end()); }
};

class Queue {
public:
  Queue(std::vector<Scene> scenes, const RunStore& store, int cores)
      : waiting_(std::move(scenes)), store_(store), cores_(cores), count_(waiting_.size()),
        terminal_(isatty(STDERR_FILENO)) {
    std::ranges::sort(waiting_, std::greater<>(), cost_of);
    for (const Scene& scene : waiting_) whole_cost_ += cost_of(scene);
  }

  std::vector<FailedRun> run() {
    QTimer watch;
    QObject::connect(&watch, &QTimer::timeout, [this] { look(); });
    watch.start(200);
    fill();
    if (!jobs_.empty()) loop_.exec();
    clear_line();
    if (!trouble_.empty()) throw StoreError(trouble_);
    return std::move(failed_);
  }

private:
  void fill() {
    while (!waiting_.empty() && int(jobs_.size()) < cores_ && trouble_.empty() &&
           !interrupt_requested()) {
      start(waiting_.front());
      waiting_.erase(waiting_.begin());
    }
    if (jobs_.empty()) loop_.quit();
  }

  void start(const Scene& scene) {
    const int at_once = std::min<int>(cores_, int(jobs_.size() + waiting_.size()));
    auto job = std::make_unique<Job>();
    job->scene = scene;
    job->order = store_.begin(scene);
    Job* here = job.get();
    const auto ended = [this, here] { end(*here); };
    QObject::connect(job->process, qOverload<int, QProcess::ExitStatus>(&QProcess::finished),
                     ended);
    QObject::connect(job->process, &QProcess::errorOccurred, [=](QProcess::ProcessError error) {
      if (error == QProcess::FailedToStart) ended();
    });
    job->process->setStandardOutputFile(QProcess::nullDevice());
    QStringList arguments{"run"};
    const QString folder = QString::fromStdString(job->order.folder.string());
    if (holds_run(job->order.folder)) // an earlier command was interrupted
      arguments << "--resume" << folder;
    else
      arguments << QString::fromStdString(job->order.scene.string()) << "-o" << folder << "--force";
    arguments << "--no-pictures"
              << "--threads" << QString::number(cores_ / at_once);
    job->process->start(QCoreApplication::applicationFilePath(), arguments);
    jobs_.push_back(std::move(job));
  }

  void end(Job& job) {
    const double seconds = std::chrono::duration<double>(Clock::now() - job.begin).count();
    const bool good = job.process->exitStatus() == QProcess::NormalExit &&
                      job.process->error() != QProcess::FailedToStart &&
                      job.process->exitCode() == 0;
    try {
      if (good) store_.finish(job.scene);
    } catch (const StoreError& e) {
      trouble_ = e.what();
    }
    if (!good && !interrupt_requested())
      failed_.push_back({job.scene.name, reason(*job.process, job.order.folder)});
    if (good) done_cost_ += cost_of(job.scene);
    clear_line();
    if (!interrupt_requested())
      say(fmt::format("{} of {}: {} {} {}\n", ++done_, count_, job.scene.name,
                      good ? "ran in" : "stopped after", duration_text(seconds)));
    job.process->disconnect();
    std::erase_if(jobs_, [&](const auto& each) { return each.get() == &job; });
    fill();
  }

  void look() {
    if (interrupt_requested())
      for (const auto& job : jobs_) job->process->terminate();
    if (!terminal_ || jobs_.empty()) return;
    std::vector<std::string> shares;
    double cost = done_cost_;
    for (const auto& job : jobs_) {
      const double share = job->share();
      cost += share * cost_of(job->scene);
      shares.push_back(fmt::format("{} {:.0f} %", job->scene.name, 100 * share));
    }
    const double seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
    const std::string left =
        cost > 0.02 * whole_cost_
            ? fmt::format("   {} left", duration_text(seconds * (whole_cost_ / cost - 1)))
            : "";
    std::string line =
        fmt::format("run {} to {} of {}{}   {}", done_ + 1, done_ + int(jobs_.size()), count_, left,
                    fmt::join(shares, ", "));
    line.resize(width, ' ');
    std::fprintf(stderr, "\r%s", line.c_str());
  }

  void clear_line() const {
    if (terminal_) std::fprintf(stderr, "\r%*s\r", int(width), "");
  }

  static constexpr std::size_t width = 79;
  std::vector<Scene> waiting_;
  const RunStore& store_;
  int cores_;
  std::size_t count_;
  int done_ = 0;
  double whole_cost_ = 0, done_cost_ = 0;
  bool terminal_;
  std::vector<std::unique_ptr<Job>> jobs_;
  std::vector<FailedRun> failed_;
  std::string trouble_; ///< of the store; nothing new is begun then
  Clock::time_point begin_ = Clock::now();
  QEventLoop loop_;
};

} // namespace

std::vector<FailedRun> run_all(std::vector<Scene> scenes, const RunStore& store, int cores) {
  std::erase_if(scenes, [&](const Scene& scene) { return store.has(scene); });
  if (scenes.empty()) return {};
  render::begin_qt();
  return Queue(std::move(scenes), store, cores).run();
}

} // namespace lamella
