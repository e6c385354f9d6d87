#include "experiments/tables/fronts.h"

#include <algorithm>
#include <tuple>

namespace relight::tables {

std::vector<size_t> pareto_front(const std::vector<Point>& points, ErrorKind error, CostKind cost,
                                 const std::string& method) {
  const auto place = [&](size_t i) { return std::tuple(points[i][cost].value, points[i][error].value, i); };
  std::vector<size_t> order;
  for (size_t i = 0; i < points.size(); ++i)
    if (points[i].comparable(error, cost) && (method.empty() || points[i].method == method))
      order.push_back(i);
  std::sort(order.begin(), order.end(), [&](size_t a, size_t b) { return place(a) < place(b); });
  std::vector<size_t> front;
  for (const size_t i : order) {
    if (front.empty()) {
      front.push_back(i);
      continue;
    }
    const Point& last = points[front.back()];
    const bool equal =
        points[i][error].value == last[error].value && points[i][cost].value == last[cost].value;
    if (equal || points[i][error].value < last[error].value) front.push_back(i);
  }
  return front;
}

}  // namespace relight::tables
