// The module scotopic._core: what scotopic/__init__.py calls. Arguments are checked and named there.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "report/image_report.h"
#include "host/operator.h"
#include "pipeline/rows/threads.h"
#include "python/arrays.h"
#include "python/photometry.h"

namespace scotopic {
namespace {

namespace py = pybind11;

/// Notes of a run as (is_detail, line), in their order; handed to logging afterwards.
class NoteList {
 public:
  Notes notes() {
    return {[this](const std::string& line) { add(false, line); },
            [this](const std::string& line) { add(true, line); }};
  }
  std::vector<std::pair<bool, std::string>> take() { return std::move(lines_); }

 private:
  void add(bool detail, const std::string& line) {
    const std::lock_guard guard(lock_);
    lines_.emplace_back(detail, line);
  }

  std::mutex lock_;
  std::vector<std::pair<bool, std::string>> lines_;
};

/// What is the same for a single image and each of a stack.
struct FrameArguments {
  std::optional<int> frame;
  bool straight = false;
  double pixel_aspect = 1;
};

MemoryJob job_of(const py::array& in, const FrameArguments& a) {
  MemoryJob job;
  job.in = pixels_of(in);
  job.header.name = "rgb";
  job.header.data = job.header.display = job.window = {0, 0, job.in.width, job.in.height};
  job.header.straight = a.straight;
  job.header.pixel_aspect = a.pixel_aspect;
  job.frame = a.frame;
  return job;
}

std::vector<std::pair<bool, std::string>> apply(const HostOperator& op, const py::array& in, py::array& out,
                                                const FrameArguments& arguments) {
  MemoryJob job = job_of(in, arguments);
  (void)out.mutable_data();  // ValueError where it may not be written
  job.out = pixels_of(out);
  NoteList notes;
  const py::gil_scoped_release others_may_run;
  (void)op.apply(job, notes.notes());
  return notes.take();
}

std::string explain(const HostOperator& op, const py::array& in, const FrameArguments& arguments) {
  const MemoryJob job = job_of(in, arguments);
  const py::gil_scoped_release others_may_run;
  return op.explain(job, {}).dump();
}

std::string plan(const HostOperator& op, const py::array& in, const FrameArguments& arguments) {
  const MemoryJob job = job_of(in, arguments);
  const py::gil_scoped_release others_may_run;
  return plan_json(op.plan(job, {}).plan).dump();
}

std::string bake(const HostOperator& op, const std::string& path, const std::string& size,
                 const std::string& max_error) {
  const py::gil_scoped_release others_may_run;
  return op.bake(path, size, max_error, {}).dump();
}

std::string shader(const HostOperator& op, const std::string& language) {
  const py::gil_scoped_release others_may_run;
  return op.shader(language);
}

std::vector<py::tuple> parameters() {
  std::vector<py::tuple> out;
  for (const ParameterInfo& p : parameter_list())
    out.push_back(py::make_tuple(p.name, p.group, p.takes, p.sentence));
  return out;
}

/// "FILE: what", as the program says it.
std::string line_of(const Error& error) {
  return error.file().empty() ? error.what() : error.file() + ": " + error.what();
}

void translate(std::exception_ptr failure) {
  try {
    if (failure) std::rethrow_exception(failure);
  } catch (const Error& error) {
    PyObject* const type = error.code() == ExitCode::internal ? PyExc_RuntimeError
                           : error.code() == ExitCode::output ? PyExc_OSError
                           : error.code() == ExitCode::limit  ? PyExc_MemoryError
                                                              : PyExc_ValueError;
    PyErr_SetString(type, line_of(error).c_str());
  }
}

void add_operator(py::module_& m) {
  py::class_<FrameArguments>(m, "FrameArguments")
      .def(py::init([](std::optional<int> frame, bool straight, double aspect) {
        return FrameArguments{frame, straight, aspect};
      }));
  py::class_<HostOperator>(m, "Operator")
      .def(py::init([](const Parameters& parameters) {
        const py::gil_scoped_release others_may_run;
        return std::make_unique<HostOperator>(parameters);
      }))
      .def("apply", apply)
      .def("explain", explain)
      .def("plan", plan)
      .def("bake", bake)
      .def("shader", shader);
}

}  // namespace
}  // namespace scotopic

PYBIND11_MODULE(_core, m) {
  using namespace scotopic;
  pybind11::register_exception_translator(translate);
  m.attr("__version__") = SCOTOPIC_VERSION;
  m.def("parameters", parameters);
  m.def("set_threads", set_threads);
  m.def("threads", threads_in_use);
  add_operator(m);
  add_photometry(m);
}
