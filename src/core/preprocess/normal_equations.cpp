#include "core/preprocess/normal_equations.h"

#include "core/preprocess/elimination_kernels.h"

namespace light_field_depth
{
NormalEquations::NormalEquations(int unknowns)
    : unknowns_(unknowns), stride_(strideOf(unknowns)),
      matrix_(static_cast<std::size_t>(unknowns) * static_cast<std::size_t>(stride_), 0.0F),
      side_(static_cast<std::size_t>(unknowns), 0.0F)
{
}

int NormalEquations::strideOf(int unknowns)
{
  return (unknowns + ELIMINATED_FLOATS - 1) / ELIMINATED_FLOATS * ELIMINATED_FLOATS;
}

void NormalEquations::eliminate(const float* coupling, float own, float own_side)
{
  eliminateUnknown(coupling, own, unknowns_, stride_, matrix_.data());
  for (int unknown = 0; unknown < unknowns_; ++unknown)
  {
    side(unknown) -= coupling[unknown] / own * own_side;
  }
}

}  // namespace light_field_depth
