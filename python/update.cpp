// lamella._update: updates of pipelines as Python needs them. While vesicles compute, other threads
// of Python go on; its signals (Ctrl-C, a notebook's stop) end the update within a step; what is
// reported comes back as text.
#include <vtkPython.h> // before all others

#include <vtkAlgorithm.h>
#include <vtkCommand.h>
#include <vtkExecutive.h>
#include <vtkNew.h>
#include <vtkPythonUtil.h>
#include <vtkSmartPointer.h>

#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace {

/// The interpreter's lock, which a thread gives away while algorithms compute and holds again for
/// all that observe them: VTK may be built so that observers in Python do not take it themselves.
class Lock {
public:
  void begin_to_compute() { computing_ = true; }
  void end_to_compute() { computing_ = false; }
  void enter_observers() {
    if (!is_ours()) return;
    if (depth_++ == 0 && thread_) PyEval_RestoreThread(std::exchange(thread_, nullptr));
  }
  void leave_observers() {
    if (!is_ours()) return;
    if (--depth_ == 0 && computing_) thread_ = PyEval_SaveThread();
  }

private:
  /// Another thread, which has the lock, may cause events too: by aborting.
  bool is_ours() const { return std::this_thread::get_id() == owner_; }

  const std::thread::id owner_ = std::this_thread::get_id();
  bool computing_ = false;
  int depth_ = 0; // observers may cause events
  PyThreadState* thread_ = nullptr;
};

template <class Derived>
class Command : public vtkCommand {
public:
  static Derived* New() { return new Derived; }
};

/// The first to hear of any event of an algorithm that computes without the lock, and the last.
class First final : public Command<First> {
public:
  void Execute(vtkObject*, unsigned long event, void*) override {
    lock->enter_observers();
    if (event == StartEvent) lock->begin_to_compute();
    if (event == EndEvent) lock->end_to_compute();
  }
  Lock* lock = nullptr;
};
class Last final : public Command<Last> {
public:
  void Execute(vtkObject*, unsigned long, void*) override { lock->leave_observers(); }
  Lock* lock = nullptr;
};

/// What is reported during an update, and a signal's exception that ended it.
class Watch final : public Command<Watch> {
public:
  void Execute(vtkObject* caller, unsigned long event, void* data) override {
    switch (event) {
    case ProgressEvent:
      hear(*vtkAlgorithm::SafeDownCast(caller));
      break;
    case ErrorEvent:
      errors.emplace_back(static_cast<const char*>(data));
      failed.insert(caller);
      break;
    default:
      warnings.emplace_back(static_cast<const char*>(data));
    }
  }

  PyObject* hear_signals = nullptr; // called at every progress; an exception ends the update

  /// That exception, raised again.
  bool raise_interrupt() {
    if (!type_) return false;
    PyErr_Restore(type_, value_, traceback_);
    type_ = value_ = traceback_ = nullptr;
    return true;
  }

  std::vector<std::string> errors, warnings;
  std::set<vtkObject*> failed;

private:
  void hear(vtkAlgorithm& algorithm) {
    if (!type_) {
      PyObject* result = PyObject_CallNoArgs(hear_signals);
      if (!result) PyErr_Fetch(&type_, &value_, &traceback_);
      Py_XDECREF(result);
    }
    if (type_) algorithm.AbortExecuteOn();
  }

  PyObject *type_ = nullptr, *value_ = nullptr, *traceback_ = nullptr;
};

/// Observers, as long as this lives.
class Observing {
public:
  Observing() = default;
  ~Observing() {
    for (const auto& [object, tag] : tags_) object->RemoveObserver(tag);
  }
  Observing(const Observing&) = delete;
  void operator=(const Observing&) = delete;

  void observe(vtkObject* object, unsigned long event, vtkCommand* command, float priority) {
    tags_.emplace_back(object, object->AddObserver(event, command, priority));
  }

private:
  std::vector<std::pair<vtkSmartPointer<vtkObject>, unsigned long>> tags_;
};

/// What has failed fails again when it is asked again.
void forget_failures(const Watch& watch) {
  for (vtkObject* object : watch.failed) {
    auto* executive = vtkExecutive::SafeDownCast(object);
    (executive ? executive->GetAlgorithm() : object)->Modified();
  }
}

PyObject* list_of(const std::vector<std::string>& texts) {
  PyObject* list = PyList_New(Py_ssize_t(texts.size()));
  for (std::size_t n = 0; list && n < texts.size(); ++n)
    PyList_SET_ITEM(list, Py_ssize_t(n),
                    PyUnicode_DecodeUTF8(texts[n].data(), Py_ssize_t(texts[n].size()), "replace"));
  return list;
}

/// The algorithms of a sequence; false where Python has an exception.
bool algorithms_in(PyObject* sequence, std::vector<vtkAlgorithm*>& algorithms) {
  const Py_ssize_t size = PySequence_Size(sequence);
  for (Py_ssize_t n = 0; n < size; ++n) {
    PyObject* item = PySequence_GetItem(sequence, n);
    auto* algorithm =
        vtkAlgorithm::SafeDownCast(vtkPythonUtil::GetPointerFromObject(item, "vtkAlgorithm"));
    Py_XDECREF(item); // the sequence has it
    if (!algorithm) return false;
    algorithms.push_back(algorithm);
  }
  return size >= 0;
}

PyObject* run(PyObject*, PyObject* arguments) {
  PyObject *function, *pipeline, *unlocked, *hear_signals;
  if (!PyArg_ParseTuple(arguments, "OOOO", &function, &pipeline, &unlocked, &hear_signals))
    return nullptr;
  std::vector<vtkAlgorithm*> all, ours;
  if (!algorithms_in(pipeline, all) || !algorithms_in(unlocked, ours)) return nullptr;

  constexpr float first = 1e30f, before_others = 1e29f, last = -1e30f;
  Lock lock;
  vtkNew<First> enter;
  vtkNew<Last> leave;
  vtkNew<Watch> watch;
  enter->lock = leave->lock = &lock;
  watch->hear_signals = hear_signals;
  PyObject* result;
  {
    Observing observing;
    for (vtkAlgorithm* algorithm : all) {
      for (const auto event :
           {vtkCommand::ErrorEvent, vtkCommand::WarningEvent, vtkCommand::ProgressEvent})
        observing.observe(algorithm, event, watch, before_others);
      observing.observe(algorithm->GetExecutive(), vtkCommand::ErrorEvent, watch, before_others);
    }
    for (vtkAlgorithm* algorithm : ours) {
      observing.observe(algorithm, vtkCommand::AnyEvent, enter, first);
      observing.observe(algorithm, vtkCommand::AnyEvent, leave, last);
    }
    result = PyObject_CallNoArgs(function);
  }
  forget_failures(*watch);
  if (watch->raise_interrupt() || !result) {
    Py_XDECREF(result);
    return nullptr;
  }
  Py_DECREF(result);
  return Py_BuildValue("(NN)", list_of(watch->errors), list_of(watch->warnings));
}

constexpr const char* documentation =
    "run(function, pipeline, unlocked, hear_signals): calls a function that updates a pipeline, of "
    "which the algorithms `unlocked` compute without the interpreter's lock. hear_signals() is "
    "called "
    "at every progress; what it raises ends the update. Returns what was reported: errors, "
    "warnings.";
PyMethodDef methods[] = {{"run", run, METH_VARARGS, documentation}, {nullptr, nullptr, 0, nullptr}};

PyModuleDef module{
    PyModuleDef_HEAD_INIT, "_update", nullptr, -1, methods, nullptr, nullptr, nullptr, nullptr};

} // namespace

PyMODINIT_FUNC PyInit__update() { return PyModule_Create(&module); }
