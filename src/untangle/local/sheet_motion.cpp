#include "untangle/local/sheet_motion.h"

#include <Eigen/Dense>

#include <cmath>

namespace unsnarl {
namespace {

/// The least squares of a curve's two offsets penalise their squares by this share of the number of crossings: sheets
/// that lie along each other then share the motion that parts them [E142] (no unit)
constexpr double offset_damping = 0.01;

/// How the first sheet best moves against the second at a crossing.
Vec3 steepest(const Crossing& crossing) {
  return crossing.side * crossing.direction;
}

/// One curve: the sums that give its slide and its offsets, then the one of these that is asked for.
class Curve {
 public:
  void add(const Crossing& crossing) {
    const auto normals = columns(crossing);
    products_ += normals.transpose() * normals;
    along_normals_ += normals.transpose() * steepest(crossing);
    sum_ += steepest(crossing);
    ++crossings_;
  }
  void choose(SheetMotion motion) {
    offsets_ = (products_ + offset_damping * crossings_ * Eigen::Matrix2d::Identity()).ldlt().solve(along_normals_);
    const bool slides_faster = sum_.squaredNorm() / crossings_ >= offsets_.dot(along_normals_);
    slides_ = motion == SheetMotion::slide || (motion == SheetMotion::steeper && slides_faster);
  }
  /// Not yet of unit size.
  Vec3 push(const Crossing& crossing) const { return slides_ ? sum_ : Vec3(columns(crossing) * offsets_); }
  double crossings() const { return crossings_; }

 private:
  static Eigen::Matrix<double, 3, 2> columns(const Crossing& crossing) {
    Eigen::Matrix<double, 3, 2> normals;
    normals << crossing.normals[0], crossing.normals[1];
    return normals;
  }

  Eigen::Matrix2d products_ = Eigen::Matrix2d::Zero();  // of the normals, summed
  Eigen::Vector2d along_normals_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d offsets_ = Eigen::Vector2d::Zero();  // of the first and the second sheet, least squares
  Vec3 sum_ = Vec3::Zero();
  double crossings_ = 0;
  bool slides_ = true;
};

}  // namespace

std::vector<Vec3> sheet_pushes(const Contours& contours, SheetMotion motion) {
  std::vector<Vec3> pushes;
  pushes.reserve(contours.crossings.size());
  if (motion == SheetMotion::free) {
    for (const Crossing& c : contours.crossings) pushes.push_back(steepest(c));
    return pushes;
  }
  std::vector<Curve> curves(contours.count);
  for (const Crossing& c : contours.crossings) curves[c.contour].add(c);
  for (Curve& curve : curves) curve.choose(motion);
  std::vector<double> squares(contours.count, 0);
  for (const Crossing& c : contours.crossings) {
    pushes.push_back(curves[c.contour].push(c));
    squares[c.contour] += pushes.back().squaredNorm();
  }
  for (std::size_t i = 0; i < pushes.size(); ++i) {
    const Index k = contours.crossings[i].contour;
    const double size = std::sqrt(squares[k] / curves[k].crossings());
    pushes[i] = size > 0 ? Vec3(pushes[i] / size) : Vec3(0, 0, 1);  // any direction will do
  }
  return pushes;
}

}  // namespace unsnarl
