// After the second frame of a size, a detector allocates nothing.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "support/images.hpp"
#include "thermedge/detector.hpp"
#include "thermedge/edge_fields.hpp"
#include "thermedge/probe/probe.hpp"
#include "thermedge/sim/scene.hpp"
#include "thermedge/stages/classical.hpp"

namespace {

std::atomic<long> allocations{0};

void* counted(std::size_t size, std::size_t alignment) {
  ++allocations;
  void* memory =
      alignment <= alignof(std::max_align_t)
          ? std::malloc(size)
          : std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
  if (memory == nullptr) {
    throw std::bad_alloc();
  }
  return memory;
}

}  // namespace

void* operator new(std::size_t size) { return counted(size, 1); }
void* operator new[](std::size_t size) { return counted(size, 1); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return counted(size, static_cast<std::size_t>(alignment));
}
void* operator new[](std::size_t size, std::align_val_t alignment) {
  return counted(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

namespace thermedge {
namespace {

// Frames of one size with ever more in them: flat, a scene, noise alone.
std::vector<Image<std::uint16_t>> growing_frames() {
  std::vector<Image<std::uint16_t>> frames;
  Image<std::uint16_t> flat(160, 120);
  fill_pixels(flat.view(), std::uint16_t{3000});
  frames.push_back(flat.clone());
  frames.push_back(std::move(flat));
  sim::SceneOptions scene;
  scene.camera.width = 160;
  scene.camera.height = 120;
  frames.push_back(std::move(sim::render(scene, 0)->counts));
  frames.push_back(test::noise_image<std::uint16_t>(160, 120, 3000, 200, 3));
  return frames;
}

void expect_none_after_the_second_frame(const DetectorOptions& options) {
  auto detector = Detector::create(options);
  ASSERT_TRUE(detector);
  const auto frames = growing_frames();
  Detection detection;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const long before = allocations;
    const Status status = detector->detect(frames[i], detection);
    const long spent = allocations - before;
    ASSERT_TRUE(status);
    if (i >= 2) {
      EXPECT_EQ(spent, 0) << "frame " << i << " with " << detection.edges.edges.size() << " edges, "
                          << options.threads << " threads";
    }
  }
}

TEST(Allocation, OfTheRobustDetectorIsNoneAfterTheSecondFrame) {
  for (const int threads : {1, 2}) {
    for (const Preset preset : {Preset::kRobust, Preset::kFast}) {
      DetectorOptions options = DetectorOptions(preset);
      options.threads = threads;
      expect_none_after_the_second_frame(options);
    }
  }
}

class AllocationOf : public testing::TestWithParam<std::tuple<DenoiseMethod, int>> {};

TEST_P(AllocationOf, ADetectorIsNoneAfterTheSecondFrame) {
  DetectorOptions options = DetectorOptions(Preset::kPaper);
  std::tie(options.denoise.method, options.threads) = GetParam();
  options.stripes.remove = true;
  options.paper()->contours.min_component_px = 0;  // as many curves as there can be
  options.paper()->contours.min_length_px = 2;
  options.selection.keep_edges = 0;
  expect_none_after_the_second_frame(options);
}

std::string name_of(const testing::TestParamInfo<std::tuple<DenoiseMethod, int>>& test) {
  const auto [method, threads] = test.param;
  return std::string(kDenoiseMethods[static_cast<std::size_t>(method)].name) + "_" +
         std::to_string(threads) + "_threads";
}

INSTANTIATE_TEST_SUITE_P(
    All, AllocationOf,
    testing::Combine(testing::Values(DenoiseMethod::kNone, DenoiseMethod::kGaussian,
                                     DenoiseMethod::kNlm, DenoiseMethod::kBm3d),
                     testing::Values(1, 2)),
    name_of);

TEST(Allocation, ClassicalDetectorsAllocateOnTheFirstFrameOnly) {
  ClassicalDetector detector;
  const auto runner = make_runner(1);
  Image<std::uint8_t> edges(160, 120);
  for (const ClassicalName& known : kClassicalMethods) {
    Image<float> levels(160, 120);
    long spent = 0;
    for (const auto& frame : growing_frames()) {
      copy_pixels(frame.view(), levels.view());
      const long before = allocations;
      ASSERT_TRUE(detector.run(levels, known.method, edges, *runner));
      spent = allocations - before;
    }
    EXPECT_EQ(spent, 0) << known.name;
  }
}

TEST(Allocation, OfAProbeIsNoneAfterTheSecondFrame) {
  auto frames = growing_frames();
  frames.push_back(frames.back().clone());  // a freeze and what follows it
  frames.push_back(frames.back().clone());
  frames.push_back(test::noise_image<std::uint16_t>(160, 120, 9000, 200, 4));
  RecordingProbe probe({.find_input_faults = false});
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const long before = allocations;
    const Status status = probe.add(frames[i]);
    const long spent = allocations - before;
    ASSERT_TRUE(status);
    if (i >= 2) {
      EXPECT_EQ(spent, 0) << "frame " << i;
    }
  }
  EXPECT_EQ(probe.report().offset_jumps, 1);
}

TEST(Allocation, TheCounterCounts) {
  const long before = allocations;
  const Image<float> image(8, 8);
  EXPECT_GT(allocations, before);
}

}  // namespace
}  // namespace thermedge
