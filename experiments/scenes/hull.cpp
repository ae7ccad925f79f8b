#include <fmt/format.h>

#include <cstdio>
#include <memory>

extern "C" {
#include <libqhull_r/qhull_ra.h>
}
#undef infinity  // a macro of Qhull's

#include "error.h"
#include "scenes/body_shapes.h"

namespace pbdcheck {
namespace {

struct Qhull {
  qhT state{};

  Qhull() { qh_zero(&state, nullptr); }
  ~Qhull() {
    qh_freeqhull(&state, !qh_ALL);
    int kept = 0, bytes = 0;
    qh_memfreeshort(&state, &kept, &bytes);
  }
  Qhull(const Qhull&) = delete;
  Qhull& operator=(const Qhull&) = delete;

  /// False where the points have no hull of a positive volume. Qhull's own messages are dropped.
  bool run(pbd::Points& points) {
    const std::unique_ptr<FILE, int (*)(FILE*)> nowhere(std::fopen("/dev/null", "w"), &std::fclose);
    char command[] = "qhull Qt";  // every facet a triangle
    return qh_new_qhull(&state, 3, static_cast<int>(points.cols()), points.data(), false, command, nullptr,
                        nowhere.get()) == qh_ERRnone;
  }
};

}  // namespace

std::string qhull_version() {
  return qh_version2;
}

pbd::TriangleMesh convex_hull(pbd::Points points) {
  const Eigen::Index count = points.cols();
  Qhull hull;
  if (count < 4) throw pbd::SetupError("convex hull", fmt::format("{} points", count), "four points or more");
  if (!hull.run(points)) {
    const pbd::Vec3 size = points.rowwise().maxCoeff() - points.rowwise().minCoeff();
    throw pbd::SetupError(
        "convex hull", fmt::format("{} points within {:g} x {:g} x {:g} m", count, size[0], size[1], size[2]),
        "points that do not lie in one plane, as seen at the size of the whole");
  }
  std::vector<int> index(static_cast<std::size_t>(count), -1);  // in the hull
  pbd::TriangleMesh found{pbd::Points(3, hull.state.num_vertices), {}};
  int used = 0;
  for (const facetT* facet = hull.state.facet_list; facet->next != nullptr; facet = facet->next) {
    std::array<int, 3> triangle{};
    for (int k = 0; k < 3; ++k) {
      auto* vertex = static_cast<vertexT*>(SETelem_(facet->vertices, k));
      int& own = index[static_cast<std::size_t>(qh_pointid(&hull.state, vertex->point))];
      if (own < 0) {
        own = used++;
        found.x.col(own) = pbd::Vec3::Map(vertex->point);
      }
      triangle[static_cast<std::size_t>(k)] = own;
    }
    if (facet->toporient != 0) std::swap(triangle[0], triangle[1]);
    found.triangles.push_back(triangle);
  }
  found.x.conservativeResize(3, used);
  return found;
}

}  // namespace pbdcheck
