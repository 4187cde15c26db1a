#pragma once
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkTimeStamp.h>

#include <algorithm>
#include <set>

namespace lamella {

/// Whether the update of an algorithm was aborted. It is then never up to date, and goes on when it
/// is asked again.
class Unfinished {
public:
  void set(bool unfinished) { unfinished_ = unfinished; }
  bool get() const { return unfinished_; }
  /// The modification time of the algorithm, given that of its parameters.
  vtkMTimeType modification_time(vtkMTimeType parameters) {
    if (unfinished_) last_asked_.Modified();
    return std::max(parameters, last_asked_.GetMTime());
  }

private:
  bool unfinished_ = false;
  vtkTimeStamp last_asked_;
};

/// One update of an algorithm that can be aborted: requests for the same time, by one output port
/// after the other. The first request computes; what comes of it, be it a state, an error, or a
/// state on the way where it was aborted, is the others' too. After an abort a port that asks again
/// begins another round.
class UpdateRound {
public:
  /// Whether a request begins a round, given the modification time of the algorithm's parameters.
  bool begins(int port, double time, vtkMTimeType parameters) {
    const bool again = unfinished_.get() && ports_.contains(port);
    const bool anew = parameters != parameters_ || time != time_ || again;
    if (anew) ports_.clear();
    ports_.insert(port);
    time_ = time;
    return anew;
  }
  /// What came of the request that began it. Aborting modifies an algorithm, too: given is the time
  /// after it.
  void ends(bool failed, bool aborted, vtkMTimeType parameters) {
    failed_ = failed;
    unfinished_.set(aborted);
    parameters_ = parameters;
  }
  bool failed() const { return failed_; }
  bool aborted() const { return unfinished_.get(); }

  /// The modification time of the algorithm, given that of its parameters.
  vtkMTimeType modification_time(vtkMTimeType parameters) {
    return unfinished_.modification_time(parameters);
  }

private:
  std::set<int> ports_; // that have asked
  double time_ = 0;
  vtkMTimeType parameters_ = 0; // 0: no round yet
  bool failed_ = false;
  Unfinished unfinished_;
};

} // namespace lamella
