#ifndef LIGHT_FIELD_DEPTH_TEST_FUZZ_HARNESSES_H
#define LIGHT_FIELD_DEPTH_TEST_FUZZ_HARNESSES_H

#include <array>
#include <cstddef>
#include <cstdint>

namespace light_field_depth::fuzz
{
using Input = void (*)(const std::uint8_t* data, std::size_t size);

/// One way in for bytes that somebody else has made. Anything but a right result or an InputError with a
/// sentence ends the program.
struct Harness
{
  const char* name;  ///< of its folder in corpus/
  Input run;
};

void fuzzEstimator(const std::uint8_t* data, std::size_t size);
void fuzzPfm(const std::uint8_t* data, std::size_t size);
void fuzzLightFieldYaml(const std::uint8_t* data, std::size_t size);
void fuzzParametersCfg(const std::uint8_t* data, std::size_t size);
void fuzzTransformsJson(const std::uint8_t* data, std::size_t size);
void fuzzNames(const std::uint8_t* data, std::size_t size);
void fuzzOptions(const std::uint8_t* data, std::size_t size);
void fuzzArrayYaml(const std::uint8_t* data, std::size_t size);
void fuzzCameraInfo(const std::uint8_t* data, std::size_t size);
void fuzzImageMessage(const std::uint8_t* data, std::size_t size);

constexpr std::array<Harness, 10> HARNESSES = {{
    {"estimator", fuzzEstimator},
    {"pfm", fuzzPfm},
    {"light_field_yaml", fuzzLightFieldYaml},
    {"parameters_cfg", fuzzParametersCfg},
    {"transforms_json", fuzzTransformsJson},
    {"names", fuzzNames},
    {"options", fuzzOptions},
    {"array_yaml", fuzzArrayYaml},
    {"camera_info", fuzzCameraInfo},
    {"image_message", fuzzImageMessage},
}};

}  // namespace light_field_depth::fuzz

#endif  // LIGHT_FIELD_DEPTH_TEST_FUZZ_HARNESSES_H
