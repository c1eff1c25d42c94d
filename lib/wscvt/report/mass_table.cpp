// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/report/mass_table.h"

#include <initializer_list>

#include "wscvt/base/text_format.h"

namespace wscvt {

namespace {

std::string listed(std::initializer_list<double> numbers) {
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "" : ", ") + format_number(number);
  return text;
}

}  // namespace

std::vector<std::vector<std::string>> mass_rows(const std::vector<NamedMass>& bodies) {
  std::vector<std::vector<std::string>> rows = {{"Mass at unit density"},
                                                {"  centroid x, y, z, length"},
                                                {"  inertia about it xx, yy, zz, length^5"},
                                                {"  inertia about it xy, xz, yz, length^5"},
                                                {"  principal moments, length^5"},
                                                {"  principal axes, quaternion w, x, y, z"}};
  for (const NamedMass& body : bodies) {
    const MassProperties& mass = body.mass;
    const Eigen::Matrix3d& tensor = mass.inertia_tensor;
    const Vector3& moments = mass.principal_moments;
    const Eigen::Quaterniond& axes = mass.principal_axes;
    rows[0].push_back(body.name);
    rows[1].push_back(listed({mass.centroid.x(), mass.centroid.y(), mass.centroid.z()}));
    rows[2].push_back(listed({tensor(0, 0), tensor(1, 1), tensor(2, 2)}));
    rows[3].push_back(listed({tensor(0, 1), tensor(0, 2), tensor(1, 2)}));
    rows[4].push_back(listed({moments[0], moments[1], moments[2]}));
    rows[5].push_back(listed({axes.w(), axes.x(), axes.y(), axes.z()}));
  }
  return rows;
}

}  // namespace wscvt
