// Depth maps of the floor world: arrays in, fixtures out.
#include "handey/world/depth_map.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>

#include "configurations.hpp"
#include "handey/collision/checker.hpp"
#include "handey/world/body.hpp"
#include "interruptible.hpp"

namespace py = pybind11;

namespace handey::bindings {
namespace {

/// A 2-D array of real numbers, NaN allowed, as doubles times `scale`.
struct Measured {
  int rows = 0, columns = 0;
  std::vector<double> values;
};

template <class Number>
void append_scaled(const py::array& given, double scale, std::vector<double>& values) {
  const py::array_t<Number, py::array::c_style | py::array::forcecast> numbers(given);
  const Number* data = numbers.data();
  values.resize(static_cast<std::size_t>(numbers.size()));
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(data[i]) * scale;
}

Measured measured(const py::object& object, const std::string& place, double scale) {
  const py::array given = numbers(object, place);
  const char kind = given.dtype().kind();
  if (given.ndim() != 2) {
    throw InvalidInput("E_SHAPE", place,
                       "has " + std::to_string(given.ndim()) + " dimensions; expected 2");
  }
  constexpr py::ssize_t kMost = std::numeric_limits<int>::max();
  if (given.size() > kMost) throw InvalidInput("E_TOO_BIG", place, "has too many entries");
  Measured result;
  result.rows = static_cast<int>(given.shape(0));
  result.columns = static_cast<int>(given.shape(1));
  if (kind == 'u' && given.itemsize() == 2) {
    append_scaled<std::uint16_t>(given, scale, result.values);
  } else if (kind == 'f' && given.itemsize() == 4) {
    append_scaled<float>(given, scale, result.values);
  } else {
    append_scaled<double>(given, scale, result.values);
  }
  return result;
}

std::vector<char> flags(const py::object& object, const DepthImage& image) {
  if (object.is_none()) return {};
  const py::array given = py::array::ensure(object);
  if (!given || given.dtype().kind() != 'b') {
    PyErr_Clear();
    throw py::type_error("explained: expected an array of booleans");
  }
  if (given.ndim() != 2 || given.shape(0) != image.rows || given.shape(1) != image.columns) {
    throw InvalidInput("E_SHAPE", "explained",
                       "expected shape (" + std::to_string(image.rows) + ", " +
                           std::to_string(image.columns) + ")");
  }
  const py::array_t<bool, py::array::c_style | py::array::forcecast> values(given);
  return {values.data(), values.data() + values.size()};
}

py::array_t<double> grid(const std::vector<double>& values, int rows, int columns) {
  py::array_t<double> result({rows, columns});
  std::memcpy(result.mutable_data(), values.data(), values.size() * sizeof(double));
  return result;
}

void bind_maps(py::module_& m) {
  py::class_<HeightMap>(m, "HeightMap",
                        R"(Heights over a plane: an obstacle known by measurement.

Args:
    heights: (rows, columns) [m], rows along +y, columns along +x; each stands for a square column
        about it, solid from z = 0 up to the height. NaN: not measured, as high as the highest.
    cell: side of a column [m].
    X_WD: the map in the world, (4, 4); identity by default.)")
      .def(py::init([](const py::object& heights, const py::object& cell, const py::object& X_WD) {
             Measured values = measured(heights, "heights", 1.0);
             HeightMap map;
             map.rows = values.rows;
             map.columns = values.columns;
             map.heights = std::move(values.values);
             map.cell = real_number(cell, "cell");
             if (!X_WD.is_none()) map.X_WD = real_pose(X_WD, "X_WD");
             return map;
           }),
           py::arg("heights"), py::kw_only(), py::arg("cell"), py::arg("X_WD") = py::none())
      .def_property_readonly(
          "heights",
          [](const HeightMap& self) { return grid(self.heights, self.rows, self.columns); },
          "(rows, columns) [m]; a copy.")
      .def_readonly("cell", &HeightMap::cell, "[m]")
      .def_property_readonly(
          "X_WD", [](const HeightMap& self) { return matrix(self.X_WD); }, "(4, 4)");
  py::class_<DepthImage>(m, "DepthImage",
                         R"(What a depth camera saw: an obstacle known by measurement.

Args:
    depths: (rows, columns), times `scale` the depth along the optical axis [m]; 0 or NaN: not
        measured, as near as the nearest measured pixel on the border of its hole.
    fx, fy, cx, cy: pixel (row v, column u) looks along ((u - cx) / fx, (v - cy) / fy, 1).
    scale: metres per unit of the depths.
    X_WD: the camera in the world, (4, 4): z forward, x right, y down; identity by default.
    explained: a pixel this near to a known surface belongs to it [m].
    far: space is solid this far behind a pixel, over its whole cone [m].)")
      .def(py::init([](const py::object& depths, const py::object& fx, const py::object& fy,
                       const py::object& cx, const py::object& cy, const py::object& scale,
                       const py::object& X_WD, const py::object& explained, const py::object& far) {
             const double unit = real_number(scale, "scale");
             if (!(unit > 0.0)) {
               throw InvalidInput("E_RANGE", "scale",
                                  "found " + std::to_string(unit) + ", expected a number > 0");
             }
             Measured values = measured(depths, "depths", unit);
             DepthImage image;
             image.rows = values.rows;
             image.columns = values.columns;
             image.depths = std::move(values.values);
             image.fx = real_number(fx, "fx");
             image.fy = real_number(fy, "fy");
             image.cx = real_number(cx, "cx");
             image.cy = real_number(cy, "cy");
             if (!X_WD.is_none()) image.X_WD = real_pose(X_WD, "X_WD");
             image.explained = real_number(explained, "explained");
             image.far = real_number(far, "far");
             return image;
           }),
           py::arg("depths"), py::kw_only(), py::arg("fx"), py::arg("fy"), py::arg("cx"),
           py::arg("cy"), py::arg("scale") = 1.0, py::arg("X_WD") = py::none(),
           py::arg("explained") = DepthImage().explained, py::arg("far") = DepthImage().far)
      .def_property_readonly(
          "depths",
          [](const DepthImage& self) { return grid(self.depths, self.rows, self.columns); },
          "(rows, columns) [m]; a copy.")
      .def_readonly("fx", &DepthImage::fx)
      .def_readonly("fy", &DepthImage::fy)
      .def_readonly("cx", &DepthImage::cx)
      .def_readonly("cy", &DepthImage::cy)
      .def_property_readonly(
          "X_WD", [](const DepthImage& self) { return matrix(self.X_WD); }, "(4, 4)")
      .def_readonly("explained", &DepthImage::explained, "[m]")
      .def_readonly("far", &DepthImage::far, "[m]");
}

void bind_options(py::module_& m) {
  py::class_<DepthMapOptions>(m, "DepthMapOptions",
                              R"(How closely solids follow what was measured.

Args:
    excess: they may stand out by this much near the places [m].
    growth: and this much more per metre of distance from them.
    most_excess: but no more than this far from them [m].
    most_solids: beyond this number the tolerance gives way.
    places: list of Body: where parts stand, now or in the end.
    exact_within: this near to the places nothing stands out [m].
    reach_centre: (3,) in the world.
    reach: nothing beyond the ball of this radius is kept; None: all is [m].)")
      .def(py::init([](double excess, double growth, double most_excess, int most_solids,
                       const std::vector<Body>& places, double exact_within,
                       const py::object& reach_centre, const py::object& reach) {
             DepthMapOptions options;
             options.excess = excess;
             options.growth = growth;
             options.most_excess = most_excess;
             options.most_solids = most_solids;
             options.places = places;
             options.exact_within = exact_within;
             if (!reach_centre.is_none()) {
               options.reach_centre = real_vector<3>(reach_centre, "reach_centre");
             }
             if (!reach.is_none()) options.reach = real_number(reach, "reach");
             return options;
           }),
           py::kw_only(), py::arg("excess") = DepthMapOptions().excess,
           py::arg("growth") = DepthMapOptions().growth,
           py::arg("most_excess") = DepthMapOptions().most_excess,
           py::arg("most_solids") = DepthMapOptions().most_solids,
           py::arg("places") = std::vector<Body>(),
           py::arg("exact_within") = DepthMapOptions().exact_within,
           py::arg("reach_centre") = py::none(), py::arg("reach") = py::none())
      .def_readwrite("excess", &DepthMapOptions::excess)
      .def_readwrite("growth", &DepthMapOptions::growth)
      .def_readwrite("most_excess", &DepthMapOptions::most_excess)
      .def_readwrite("most_solids", &DepthMapOptions::most_solids)
      .def_readwrite("places", &DepthMapOptions::places)
      .def_readwrite("exact_within", &DepthMapOptions::exact_within)
      .def_readwrite("reach_centre", &DepthMapOptions::reach_centre)
      .def_readwrite("reach", &DepthMapOptions::reach);
  py::class_<MeasuredBody>(m, "MeasuredBody", "A depth map as a fixture.")
      .def_readonly("body", &MeasuredBody::body,
                    "Body; without shapes if there is nothing solid within reach.")
      .def_readonly("excess", &MeasuredBody::excess,
                    "No point of a solid is farther than this from what was measured [m].")
      .def_readonly("exact_at_places", &MeasuredBody::exact_at_places,
                    "False if that would have taken too many solids.");
  py::class_<ReachBall>(m, "ReachBall", "A ball that holds all that the arm can come to.")
      .def_readonly("centre", &ReachBall::centre, "(3,) in the world [m]")
      .def_readonly("radius", &ReachBall::radius, "[m]");
}

}  // namespace

void bind_depth_map(py::module_& m) {
  bind_maps(m);
  bind_options(m);
  m.def("cover_heights", &cover_heights, py::arg("name"), py::arg("map"),
        py::arg("options") = DepthMapOptions(), Unlocked(),
        R"(A height map as a fixture of few convex solids that contain it.

Args:
    name: of the fixture.
    map: HeightMap.
    options: DepthMapOptions.

Returns:
    MeasuredBody.)");
  m.def(
      "explained_pixels",
      [](const DepthImage& image, const Cell& cell) {
        std::vector<char> found;
        {
          const Unlock unlock;
          found = explained_pixels(image, cell);
        }
        py::array_t<bool> result({image.rows, image.columns});
        std::copy(found.begin(), found.end(), result.mutable_data());
        return result;
      },
      py::arg("image"), py::arg("cell"),
      R"(Which pixels are measured and lie within `explained` of a known surface?

Args:
    image: DepthImage.
    cell: its fixtures, its parts and the robot at its start are known.

Returns:
    (rows, columns) of booleans. Points within 1e-6 m of that limit count as farther.)");
  m.def(
      "cover_depths",
      [](const std::string& name, const DepthImage& image, const py::object& explained,
         const DepthMapOptions& options) {
        const std::vector<char> mask = flags(explained, image);
        const Unlock unlock;
        return cover_depths(name, image, mask, options);
      },
      py::arg("name"), py::arg("image"), py::arg("explained") = py::none(),
      py::arg("options") = DepthMapOptions(),
      R"(What a depth camera saw as a fixture of few convex solids that contain it.

Args:
    name: of the fixture.
    image: DepthImage.
    explained: (rows, columns) of booleans: taken out; None: no pixel is.
    options: DepthMapOptions.

Returns:
    MeasuredBody.)");
  m.def("reach_ball", &reach_ball, py::arg("cell"),
        "ReachBall of the arm and what it may hold, whatever its joints do.");
  m.def(
      "unfilter_png16",
      [](const py::bytes& rows_bytes, int rows, int columns) {
        const std::string_view bytes(rows_bytes);
        const std::vector<unsigned short> values = unfilter_png16(
            reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(), rows, columns);
        py::array_t<std::uint16_t> result({rows, columns});
        std::copy(values.begin(), values.end(), result.mutable_data());
        return result;
      },
      py::arg("content"), py::kw_only(), py::arg("rows"), py::arg("columns"),
      "The grey values of a 16-bit PNG from its unpacked, still filtered rows: (rows, columns).");
}

}  // namespace handey::bindings
