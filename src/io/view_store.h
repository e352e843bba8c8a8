#ifndef LIGHT_FIELD_DEPTH_SRC_IO_VIEW_STORE_H
#define LIGHT_FIELD_DEPTH_SRC_IO_VIEW_STORE_H

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <vector>

#include <opencv2/core.hpp>

#include "io/folder_description.h"
#include "light_field_depth/core/input_limits.h"
#include "light_field_depth/core/thread_pool.h"

namespace light_field_depth
{
/// The images of a dataset, each decoded once and only when somebody asks for it. Used by one thread at a
/// time; decodes on all of its own.
class ViewStore
{
public:
  /// Gives the views their ids. @param threads 0 takes one per processor
  /// @param max_megapixels of an image file
  ViewStore(std::vector<ViewFile>& views, int threads, double max_megapixels = InputLimits().megapixels);

  /// Decodes what is not there yet; the images are CV_8U or CV_16U, grey or BGR. @param ids ViewFile::id
  /// @throw InputError of the first view that cannot be decoded
  void decode(const std::vector<std::size_t>& ids);

  /// The image of a view, decoded now if need be. @throw InputError
  const cv::Mat& image(std::size_t id);

  /// Where the image of a view that is decoded shows something (View::mask); empty: everywhere.
  const cv::Mat& mask(std::size_t id) const { return masks_[id]; }

  /// The threads that decode, for other work between two calls.
  ThreadPool& pool() { return pool_; }

private:
  /// The files that hold more than one view, as far as they are wanted.
  void readTables(const std::vector<std::size_t>& wanted);
  cv::Mat read(const ViewFile& view, cv::Mat& mask) const;
  /// Linear floats become 16 bits, with one white for all views.
  void encodeFloats(const std::vector<std::size_t>& ids);

  std::vector<ViewFile> views_;
  double max_megapixels_;
  std::optional<float> white_;  ///< of linear floats
  std::map<std::filesystem::path, cv::Mat> tables_;
  std::vector<cv::Mat> images_;
  std::vector<cv::Mat> masks_;  ///< of images_
  ThreadPool pool_;
};

/// The ids of all views, in their order.
std::vector<std::size_t> idsOf(const std::vector<ViewFile>& views);

}  // namespace light_field_depth

#endif  // LIGHT_FIELD_DEPTH_SRC_IO_VIEW_STORE_H
