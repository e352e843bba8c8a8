#ifndef LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_ELIMINATION_KERNELS_H
#define LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_ELIMINATION_KERNELS_H

namespace light_field_depth
{
/// Floats of a row of a matrix whose rows are whole vectors: a multiple of this.
constexpr int ELIMINATED_FLOATS = 16;

/// What is left of an upper triangle when an unknown is eliminated that `values` couples with the others:
/// matrix[a][b] -= (values[a] / own) * values[b] for b >= a; the elements before the diagonal may change,
/// too.
/// @param own the eliminated unknown's element on the diagonal, positive
/// @param values [stride], 0 from `size` on
/// @param stride of the rows of the matrix, a multiple of ELIMINATED_FLOATS
void eliminateUnknown(const float* values, float own, int size, int stride, float* matrix);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_CORE_PREPROCESS_ELIMINATION_KERNELS_H
