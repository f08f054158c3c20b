// The module unsnarl._native: flat arrays in, flat arrays out. Python around it (unsnarl/*.py) has the shapes, the
// types and the documentation.

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <initializer_list>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>

#include "unsnarl/certify.h"
#include "unsnarl/curves.h"
#include "unsnarl/intersections.h"
#include "unsnarl/isotopy.h"
#include "unsnarl/parts.h"
#include "unsnarl/repair.h"
#include "unsnarl/report.h"
#include "unsnarl/report_json.h"
#include "unsnarl/scene_document.h"
#include "unsnarl/seifert.h"
#include "unsnarl/sequence.h"
#include "unsnarl/stage_clock.h"
#include "unsnarl/version.h"

namespace py = pybind11;

namespace unsnarl::python {
namespace {

template <class T>
using Array = py::array_t<T, py::array::c_style>;

template <class T>
std::span<const T> span_of(const Array<T>& array) {
  return {array.data(), static_cast<std::size_t>(array.size())};
}

template <class T>
Array<T> array_of(const std::vector<T>& values) {
  return Array<T>(static_cast<py::ssize_t>(values.size()), values.data());
}

/// The one of `choices` that is called `name`.
template <class Enum>
Enum named(const char* option, const std::string& name, std::initializer_list<Enum> choices) {
  std::string all;
  for (const Enum choice : choices) {
    if (to_string(choice) == name) return choice;
    all += (all.empty() ? "'" : ", '") + std::string(to_string(choice)) + "'";
  }
  throw std::invalid_argument(std::string(option) + " is '" + name + "'; choose one of " + all);
}

FindOptions find_options(const std::string& weld, double weld_tolerance, bool both_diagonals = false, int threads = 0) {
  return {.weld = named("weld", weld, {Weld::none, Weld::seams, Weld::all}),
          .weld_tolerance = weld_tolerance,
          .both_diagonals = both_diagonals,
          .threads = threads};
}

/// Runs work(context) on a thread of its own, so that this one can serve Python meanwhile: it lets other Python threads
/// run, hands out progress and heeds Ctrl-C. What is raised there cancels the work and is raised again once that has
/// stopped.
template <class Work>
auto while_serving_python(const Work& work, const py::object& progress) {
  constexpr std::chrono::milliseconds signal_interval{50};
  Context context;
  std::mutex mutex;  // guards the next three
  std::condition_variable changed;
  std::deque<Context::Progress> reports;
  bool done = false;

  if (!progress.is_none())
    context.on_progress = [&](const Context::Progress& report) {
      const std::lock_guard lock(mutex);
      reports.push_back(report);
      changed.notify_one();
    };
  decltype(work(&context)) result;
  std::exception_ptr failure, raised;
  std::thread worker([&] {
    try {
      result = work(&context);
    } catch (...) {
      failure = std::current_exception();
    }
    const std::lock_guard lock(mutex);
    done = true;
    changed.notify_one();
  });
  for (bool running = true; running;) {
    std::deque<Context::Progress> news;
    {
      const py::gil_scoped_release others_may_run;
      std::unique_lock lock(mutex);
      changed.wait_for(lock, signal_interval, [&] { return done || !reports.empty(); });
      news.swap(reports);
      running = !done;
    }
    if (raised) continue;
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      for (const Context::Progress& report : news)
        progress(report.fraction, std::string(report.phase), report.pairs_left, report.displacement_rel);
    } catch (...) {
      raised = std::current_exception();
      context.cancel();
    }
  }
  worker.join();
  if (raised) std::rethrow_exception(raised);
  if (failure) std::rethrow_exception(failure);
  return result;
}

py::tuple py_find_intersections(const Array<double>& positions, const Array<std::int32_t>& corners,
                                const Array<std::int32_t>& offsets, const std::string& weld, double weld_tolerance,
                                bool both_diagonals, int threads) {
  const SurfaceView surface{span_of(positions), span_of(corners), span_of(offsets)};
  const FindOptions options = find_options(weld, weld_tolerance, both_diagonals, threads);
  std::vector<IntersectingPair> pairs;
  {
    const py::gil_scoped_release others_may_run;
    pairs = find_intersections(surface, options);
  }
  const auto count = static_cast<py::ssize_t>(pairs.size());
  Array<std::int32_t> faces({count, py::ssize_t{2}});
  Array<std::uint8_t> kinds(count);
  for (py::ssize_t i = 0; i < count; ++i) {
    faces.mutable_at(i, 0) = pairs[i].a;
    faces.mutable_at(i, 1) = pairs[i].b;
    kinds.mutable_at(i) = static_cast<std::uint8_t>(pairs[i].kind);
  }
  return py::make_tuple(faces, kinds);
}

py::dict py_certify(const Array<double>& positions, const Array<std::int32_t>& corners,
                    const Array<std::int32_t>& offsets, const Array<double>& moved, const std::string& weld,
                    double weld_tolerance, bool both_diagonals, int threads) {
  const SurfaceView surface{span_of(positions), span_of(corners), span_of(offsets)};
  const FindOptions options = find_options(weld, weld_tolerance, both_diagonals, threads);
  Certificate certificate;
  {
    const py::gil_scoped_release others_may_run;
    certificate = certify(surface, span_of(moved), options);
  }
  py::dict result;
  result["embedded"] = certificate.embedded();
  result["float32_embedded"] = certificate.float32_embedded();
  result["pairs"] = certificate.pairs.by_class;
  result["pairs_float32"] = certificate.pairs_float32.by_class;
  result["new_zero_area_faces"] = certificate.new_zero_area_faces;
  result["seams_closed"] = certificate.seams_closed;
  return result;
}

/// Of meshes that lie one after another in `surface`, which are called by their numbers.
SceneReport report_by_mesh(const SurfaceView& surface, const FindOptions& find, std::span<const double> positions,
                           const std::vector<std::size_t>& vertex_counts, const std::vector<std::size_t>& face_counts) {
  std::vector<SceneFile> meshes;
  std::size_t vertices = 0, faces = 0;
  for (std::size_t i = 0; i < vertex_counts.size(); ++i) {
    meshes.push_back({std::to_string(i), vertices, vertex_counts[i], faces, face_counts[i]});
    vertices += vertex_counts[i];
    faces += face_counts[i];
  }
  Certifier certifier(surface, find);
  return scene_report(surface, meshes, certifier.find_intersections(surface.positions), positions,
                      certifier.find_intersections(positions));
}

py::tuple py_repair(const Array<double>& positions, const Array<std::int32_t>& corners,
                    const Array<std::int32_t>& offsets, const Array<std::uint8_t>& fixed,
                    const std::vector<std::size_t>& vertex_counts, const std::vector<std::size_t>& face_counts,
                    const std::string& goal, const std::string& precision, double min_gap, double min_dihedral,
                    double max_displacement, bool absolute, double time_limit, double memory_limit, bool recover,
                    bool paper, bool each_component, const std::string& weld, double weld_tolerance,
                    bool both_diagonals, int threads, const py::object& progress) {
  const StageClock clock;
  const SurfaceView surface{span_of(positions), span_of(corners), span_of(offsets)};
  RepairOptions options;
  options.find = find_options(weld, weld_tolerance, both_diagonals, threads);
  options.goal = named("goal", goal, {Goal::all, Goal::disjoint});
  if (precision != "auto") options.precision = named("precision", precision, {Precision::float32, Precision::float64});
  const double diagonal = absolute ? diagonal_of(surface) : 1;
  const double unit = diagonal > 0 ? 1 / diagonal : 1;
  options.min_gap_rel = min_gap * unit;
  options.min_dihedral_deg = min_dihedral;
  options.max_displacement_rel = max_displacement * unit;
  options.time_limit_s = time_limit;
  options.memory_limit_mb = memory_limit;
  options.recover = recover;
  if (paper) options.paper.emplace();
  options.each_component = each_component;
  options.fixed.assign(fixed.data(), fixed.data() + fixed.size());

  const RepairResult result =
      while_serving_python([&](Context* context) { return repair(surface, options, context); }, progress);
  ReportFiles files;
  files.vertices = surface.vertex_count();
  files.faces = surface.face_count();
  if (!vertex_counts.empty()) {
    const py::gil_scoped_release others_may_run;
    files.scene = report_by_mesh(surface, options.find, result.positions, vertex_counts, face_counts);
  }
  files.clearance_before = measure_clearance(surface, surface.positions, options.find);
  files.clearance_after = measure_clearance(surface, result.positions, options.find);
  files.whole = clock.stage("repair");
  return py::make_tuple(array_of(result.positions), std::string(to_string(result.status)),
                        report_json(result, options, files));
}

py::list py_repair_sequence(const Array<double>& frames, const Array<std::int32_t>& corners,
                            const Array<std::int32_t>& offsets, const Array<std::uint8_t>& fixed,
                            const Array<double>& moved, std::size_t first, std::size_t last, const std::string& goal,
                            const std::string& precision, double min_gap, double max_displacement, double time_limit,
                            const std::string& weld, double weld_tolerance, bool both_diagonals, int threads,
                            const py::object& progress) {
  const std::span<const double> all = span_of(frames);
  const auto count = static_cast<std::size_t>(frames.shape(0)), size = count > 0 ? all.size() / count : 0;
  const std::span<double> results(const_cast<double*>(moved.data()), all.size());
  SequenceOptions options;
  options.first = first;
  options.last = last;
  options.repair.find = find_options(weld, weld_tolerance, both_diagonals, threads);
  options.repair.goal = named("goal", goal, {Goal::all, Goal::disjoint});
  if (precision != "auto")
    options.repair.precision = named("precision", precision, {Precision::float32, Precision::float64});
  options.repair.min_gap_rel = min_gap;
  options.repair.max_displacement_rel = max_displacement;
  options.repair.time_limit_s = time_limit;
  options.repair.fixed.assign(fixed.data(), fixed.data() + fixed.size());
  SequenceSource source;
  source.corners = span_of(corners);
  source.offsets = span_of(offsets);
  source.frames = count;
  source.positions = [&](std::size_t t) {
    const auto frame = all.subspan(t * size, size);
    return std::vector<double>(frame.begin(), frame.end());
  };
  const auto take = [&](FrameResult&& result) {
    std::copy(result.positions.begin(), result.positions.end(), results.begin() + result.report.frame * size);
  };
  const std::vector<FrameReport> reports =
      while_serving_python([&](Context* context) { return repair_sequence(source, options, take, context); }, progress);
  py::list list;
  for (const FrameReport& r : reports) {
    py::dict report;
    const auto jitter = [](const std::optional<Jitter>& j) -> py::object {
      if (!j) return py::none();
      return py::make_tuple(j->mean_rel, j->max_rel);
    };
    report["frame"] = r.frame;
    report["status"] = std::string(to_string(r.status));
    report["before"] = r.before.by_class;
    report["after"] = r.after.by_class;
    report["diagonal"] = r.diagonal;
    report["displacement_mean_rel"] = r.displacement_mean_rel;
    report["displacement_max_rel"] = r.displacement_max_rel;
    report["untouched_share"] = r.untouched_share;
    report["float32_embedded"] = r.float32_embedded;
    report["precision"] = std::string(to_string(r.precision));
    report["is_smoothed"] = r.is_smoothed;
    report["alone"] = jitter(r.alone);
    report["jitter"] = jitter(r.jitter);
    list.append(report);
  }
  return list;
}

/// Curves as Python has them: a list of flat points, flags of closed ones, flags of fixed points (empty: none).
std::vector<Curve> curves_of(const std::vector<Array<double>>& points, const std::vector<bool>& closed,
                             const std::vector<Array<std::uint8_t>>& fixed) {
  std::vector<Curve> curves(points.size());
  for (std::size_t c = 0; c < points.size(); ++c) {
    const auto p = span_of(points[c]);
    curves[c].points.assign(p.begin(), p.end());
    curves[c].closed = closed[c];
    if (c < fixed.size()) {
      const auto f = span_of(fixed[c]);
      curves[c].fixed.assign(f.begin(), f.end());
    }
  }
  return curves;
}

Array<std::int32_t> array_of(const std::vector<CurveCrossing>& crossings) {
  const auto count = static_cast<py::ssize_t>(crossings.size());
  Array<std::int32_t> result({count, py::ssize_t{4}});
  for (py::ssize_t i = 0; i < count; ++i) {
    const CurveCrossing& c = crossings[i];
    const std::array<std::int32_t, 4> row{c.curve_a, c.segment_a, c.curve_b, c.segment_b};
    for (py::ssize_t k = 0; k < 4; ++k) result.mutable_at(i, k) = row[k];
  }
  return result;
}

Array<std::int32_t> py_find_crossings(const std::vector<Array<double>>& points, const std::vector<bool>& closed) {
  return array_of(find_crossings(curves_of(points, closed, {})));
}

py::tuple py_untangle_curves(const std::vector<Array<double>>& points, const std::vector<bool>& closed,
                             const std::vector<Array<std::uint8_t>>& fixed, double gap, double junction, bool fix_ends,
                             double time_limit, bool recover, const py::object& progress) {
  const std::vector<Curve> curves = curves_of(points, closed, fixed);
  const CurveOptions options{
      .gap_rel = gap, .junction_rel = junction, .fix_ends = fix_ends, .recover = recover, .time_limit_s = time_limit};
  const CurveResult result =
      while_serving_python([&](Context* context) { return untangle_curves(curves, options, context); }, progress);
  py::list moved;
  for (const Curve& curve : result.curves) moved.append(array_of(curve.points));
  const CurveReport& r = result.report;
  py::dict report;
  report["crossings_before"] = r.crossings_before;
  report["crossings_after"] = r.crossings_after;
  report["points"] = r.points;
  report["diagonal"] = r.diagonal;
  report["displacement_mean_rel"] = r.displacement_mean_rel;
  report["displacement_max_rel"] = r.displacement_max_rel;
  report["distance_mean_rel"] = r.distance_mean_rel;
  report["distance_max_rel"] = r.distance_max_rel;
  report["moved_points"] = r.moved_points;
  report["turned_points"] = r.turned_points;
  report["inserted_points"] = r.inserted_points;
  report["joints"] = r.joints;
  report["obstructions"] = array_of(r.fixed);
  report["left"] = array_of(r.left);
  report["seconds"] = r.seconds;
  return py::make_tuple(moved, std::string(to_string(result.status)), report);
}

Link link_of(const std::vector<Array<double>>& components) {
  Link link;
  for (const Array<double>& component : components) {
    const std::span<const double> p = span_of(component);
    link.components.emplace_back(p.begin(), p.end());
  }
  return link;
}

py::dict dict_of(const SeifertFindings& found) {
  const auto integers = [](const std::vector<std::string>& coefficients) {
    py::list list;
    for (const std::string& c : coefficients) list.append(py::int_(py::str(c)));
    return list;
  };
  py::dict report;
  report["intersecting_pairs"] = found.intersecting_pairs;
  report["oriented"] = found.oriented;
  report["spans_link"] = found.spans_link;
  report["components"] = found.components;
  report["genus"] = found.genus;
  report["euler_characteristic"] = found.euler_characteristic;
  report["expected_euler_characteristic"] = found.expected_euler_characteristic;
  report["alexander_of_surface"] = integers(found.alexander_of_surface);
  report["alexander_of_link"] = integers(found.alexander_of_link);
  report["hold"] = found.hold();
  return report;
}

py::tuple py_seifert_surface(const std::vector<Array<double>>& components, double edge, int views, bool fair,
                             double time_limit, const py::object& progress) {
  const Link link = link_of(components);
  const SeifertOptions options{.edge_rel = edge, .views = views, .fair = fair, .time_limit_s = time_limit};
  SeifertFindings found;
  const SeifertResult result = while_serving_python(
      [&](Context* context) {
        SeifertResult made = seifert_surface(link, options, context);
        found = check_seifert_surface(made.surface, link, views);
        return made;
      },
      progress);
  py::dict report = dict_of(found);
  report["crossings"] = result.crossings;
  report["circles"] = result.circles;
  report["area"] = result.area;
  report["seconds"] = result.seconds;
  return py::make_tuple(array_of(result.surface.positions), array_of(result.surface.corners),
                        std::string(to_string(result.status)), report);
}

py::dict py_check_seifert_surface(const Array<double>& positions, const Array<std::int32_t>& corners,
                                  const std::vector<Array<double>>& components, int views) {
  return dict_of(check_seifert_surface({span_of(positions), span_of(corners)}, link_of(components), views));
}

py::list py_knot_of_table(const std::string& name) {
  py::list components;
  for (const std::vector<double>& component : knot_of_table(name).components) components.append(array_of(component));
  return components;
}

py::tuple py_planar_isotopy(const std::vector<Array<double>>& start, const std::vector<Array<double>>& end, int points,
                            double time_limit, const py::object& progress) {
  const std::vector<Curve> from = curves_of(start, std::vector<bool>(start.size(), true), {});
  const std::vector<Curve> to = curves_of(end, std::vector<bool>(end.size(), true), {});
  const IsotopyOptions options{.points = points, .time_limit_s = time_limit};
  const Isotopy made =
      while_serving_python([&](Context* context) { return planar_isotopy(from, to, options, context); }, progress);
  std::vector<double> times;
  py::list rings;
  for (const IsotopyRing& ring : made.rings) {
    times.push_back(ring.time);
    py::list curves;
    for (const std::vector<double>& curve : ring.curves) curves.append(array_of(curve));
    rings.append(curves);
  }
  return py::make_tuple(array_of(times), rings, array_of(made.surface.positions), array_of(made.surface.corners),
                        std::string(to_string(made.status)));
}

Array<std::int32_t> py_component_of_faces(const Array<double>& positions, const Array<std::int32_t>& corners,
                                          const Array<std::int32_t>& offsets, const std::string& weld,
                                          double weld_tolerance) {
  const FindOptions options = find_options(weld, weld_tolerance);
  return array_of(component_of_faces({span_of(positions), span_of(corners), span_of(offsets)}, options));
}

Array<std::uint8_t> py_boundary_vertices(const Array<double>& positions, const Array<std::int32_t>& corners,
                                         const Array<std::int32_t>& offsets, const std::string& weld,
                                         double weld_tolerance) {
  const FindOptions options = find_options(weld, weld_tolerance);
  return array_of(boundary_vertices({span_of(positions), span_of(corners), span_of(offsets)}, options));
}

Array<std::uint8_t> py_vertices_of_faces(const Array<double>& positions, const Array<std::int32_t>& corners,
                                         const Array<std::int32_t>& offsets, const Array<std::uint8_t>& faces) {
  return array_of(vertices_of_faces({span_of(positions), span_of(corners), span_of(offsets)}, span_of(faces)));
}

}  // namespace
}  // namespace unsnarl::python

PYBIND11_MODULE(_native, module) {
  using namespace unsnarl;
  using namespace unsnarl::python;
  module.attr("version") = std::string(version);
  py::tuple kinds(pair_class_count);
  for (std::size_t i = 0; i < pair_class_count; ++i) kinds[i] = std::string(pair_class_names[i]);
  module.attr("pair_kinds") = kinds;
  const auto array = [](const char* name) { return py::arg(name).noconvert(); };
  module.def("find_intersections", &py_find_intersections, array("positions"), array("corners"), array("offsets"),
             py::kw_only(), py::arg("weld"), py::arg("weld_tolerance"), py::arg("both_diagonals"), py::arg("threads"));
  module.def("certify", &py_certify, array("positions"), array("corners"), array("offsets"), array("moved"),
             py::kw_only(), py::arg("weld"), py::arg("weld_tolerance"), py::arg("both_diagonals"), py::arg("threads"));
  module.def("repair", &py_repair, array("positions"), array("corners"), array("offsets"), array("fixed"),
             py::kw_only(), py::arg("vertex_counts"), py::arg("face_counts"), py::arg("goal"), py::arg("precision"),
             py::arg("min_gap"), py::arg("min_dihedral"), py::arg("max_displacement"), py::arg("absolute"),
             py::arg("time_limit"), py::arg("memory_limit"), py::arg("recover"), py::arg("paper"),
             py::arg("each_component"), py::arg("weld"), py::arg("weld_tolerance"), py::arg("both_diagonals"),
             py::arg("threads"), py::arg("progress"));
  module.def("repair_sequence", &py_repair_sequence, array("frames"), array("corners"), array("offsets"),
             array("fixed"), array("moved"), py::kw_only(), py::arg("first"), py::arg("last"), py::arg("goal"),
             py::arg("precision"), py::arg("min_gap"), py::arg("max_displacement"), py::arg("time_limit"),
             py::arg("weld"), py::arg("weld_tolerance"), py::arg("both_diagonals"), py::arg("threads"),
             py::arg("progress"));
  module.def("find_crossings", &py_find_crossings, py::arg("points"), py::arg("closed"));
  module.def("untangle_curves", &py_untangle_curves, py::arg("points"), py::arg("closed"), py::arg("fixed"),
             py::kw_only(), py::arg("gap"), py::arg("junction"), py::arg("fix_ends"), py::arg("time_limit"),
             py::arg("recover"), py::arg("progress"));
  module.def("seifert_surface", &py_seifert_surface, py::arg("link"), py::kw_only(), py::arg("edge"), py::arg("views"),
             py::arg("fair"), py::arg("time_limit"), py::arg("progress"));
  module.def("check_seifert_surface", &py_check_seifert_surface, array("positions"), array("corners"), py::arg("link"),
             py::kw_only(), py::arg("views"));
  module.def("knot_of_table", &py_knot_of_table, py::arg("name"));
  module.def("planar_isotopy", &py_planar_isotopy, py::arg("start"), py::arg("end"), py::kw_only(), py::arg("points"),
             py::arg("time_limit"), py::arg("progress"));
  module.def("component_of_faces", &py_component_of_faces, array("positions"), array("corners"), array("offsets"),
             py::kw_only(), py::arg("weld"), py::arg("weld_tolerance"));
  module.def("boundary_vertices", &py_boundary_vertices, array("positions"), array("corners"), array("offsets"),
             py::kw_only(), py::arg("weld"), py::arg("weld_tolerance"));
  module.def("vertices_of_faces", &py_vertices_of_faces, array("positions"), array("corners"), array("offsets"),
             array("faces"));
}
