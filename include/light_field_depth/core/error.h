#ifndef LIGHT_FIELD_DEPTH_CORE_ERROR_H
#define LIGHT_FIELD_DEPTH_CORE_ERROR_H

#include <stdexcept>

namespace light_field_depth
{
/// Input or options that cannot be used. The text is a whole sentence for the user: it names the view, the
/// field, the value and the remedy.
class InputError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// Thrown out of a running pipeline after CancellationToken::cancel().
class Cancelled : public std::runtime_error
{
public:
  Cancelled() : std::runtime_error("The computation was cancelled.") {}
};

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_CORE_ERROR_H
