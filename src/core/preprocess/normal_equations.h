#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_NORMAL_EQUATIONS_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_NORMAL_EQUATIONS_H

#include <cstddef>
#include <vector>

namespace light_field_depth
{
/// H and b of H x = -b, of which points add their parts: only what is on and above the diagonal of H counts.
class NormalEquations
{
public:
  explicit NormalEquations(int unknowns);

  /// Numbers of a row of H, and of what eliminate() is given.
  static int strideOf(int unknowns);

  int unknowns() const { return unknowns_; }
  float* row(int unknown) { return matrix_.data() + static_cast<std::ptrdiff_t>(unknown) * stride_; }
  const float* row(int unknown) const
  {
    return matrix_.data() + static_cast<std::ptrdiff_t>(unknown) * stride_;
  }
  float& side(int unknown) { return side_[static_cast<std::size_t>(unknown)]; }
  float side(int unknown) const { return side_[static_cast<std::size_t>(unknown)]; }

  /// Takes off what an unknown of a point alone accounts for.
  /// @param own its own element of H, positive  @param own_side that of b
  /// @param coupling [strideOf()], its elements of H with the others; 0 beyond
  void eliminate(const float* coupling, float own, float own_side);

private:
  int unknowns_;
  int stride_;
  std::vector<float> matrix_;
  std::vector<float> side_;
};

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_NORMAL_EQUATIONS_H
