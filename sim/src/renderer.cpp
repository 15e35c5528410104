#include <algorithm>
#include <cmath>
#include <new>

#include "imager.hpp"
#include "motion.hpp"
#include "path.hpp"
#include "scene_keys.hpp"
#include "sensor.hpp"
#include "truth.hpp"

namespace thermedge::sim {
namespace {

Result<World> find_world(const SceneOptions& options) {
  if (is_scene_file(options.name)) {
    return load_world(options.name, options.seed);
  }
  return parse_world(*built_in_scene(options.name), "sim:" + options.name, options.seed);
}

// Brown's polynomial must grow as far as the picture reaches, or two rays would meet one pixel.
Status check_lens(const SceneOptions& options, const Lens& lens) {
  const Intrinsics& i = lens.intrinsics();
  const double corner = lens.reach().x * lens.reach().x + lens.reach().y * lens.reach().y;
  const double slope = 1 + corner * (3 * i.k1 + 5 * corner * i.k2);
  const Point back = lens.pixel(lens.ray({-0.5, -0.5}));
  if (slope > 0.05 && std::abs(back.x + 0.5) < 1e-6 && std::abs(back.y + 0.5) < 1e-6) {
    return {};
  }
  return failure(
      ErrorCode::kInvalidArgument,
      "sim:" + options.name + ": k1 and k2 bend rays back at this fov; both should be nearer to 0");
}

// Runs `work`; running out of memory becomes an error.
auto within_memory(const SceneOptions& options, const auto& work) -> decltype(work()) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    return failure(ErrorCode::kOutOfMemory,
                   "sim:" + options.name + ": out of memory; try a smaller width and height");
  }
}

}  // namespace

class Renderer::Impl {
 public:
  Impl(SceneOptions options, World world)
      : options_(std::move(options)),
        world_(std::move(world)),
        moves_(std::any_of(world_.objects.begin(), world_.objects.end(),
                           [](const Object& object) { return object.moves(); })),
        facets_(tessellate(world_)),
        lens_(intrinsics_of(options_.camera)),
        imager_(lens_, options_.camera),
        ray_caster_(world_, facets_, lens_, imager_.margin_px()),
        sensor_(options_.camera, options_.seed) {}

  [[nodiscard]] const SceneOptions& options() const { return options_; }

  TrueFrame render(int index, ParallelRunner& runner) {
    const CameraOptions& camera = options_.camera;
    TrueFrame frame;
    set_events(index, frame);
    frame.stamp_ns = std::llround(frame.index * 1e9 / camera.rate_hz);
    frame.intrinsics = lens_.intrinsics();
    frame.counts.resize(camera.width, camera.height);
    frame.clean.resize(camera.width, camera.height);
    const int shown = shown_at(camera, frame.index);
    if (shown != frame.index) {
      look(shown, frame.clean, runner);
      sensor_.expose(frame.clean, shown, frame.counts, runner);
      if (frame.freeze && frame.freeze->noise_counts > 0) {
        sensor_.repeat(frame.freeze->noise_counts, frame.index, frame.counts);
      }
    }
    frame.pose = pose_at(world_.view, options_, frame.index);
    look(frame.index, frame.clean, runner);
    if (shown == frame.index) {
      sensor_.expose(frame.clean, frame.index, frame.counts, runner);
    }
    frame.edges =
        true_edges(ray_caster_, options_.least_contrast_counts, camera.vignetting, runner);
    if (options_.depth) {
      frame.depth_mm.resize(camera.width, camera.height);
      render_depth(ray_caster_, frame.depth_mm, runner);
    }
    return frame;
  }

 private:
  [[nodiscard]] double seconds(int number) const { return number / options_.camera.rate_hz; }

  // What happened to the `index`th frame that is not dropped.
  void set_events(int index, TrueFrame& frame) const {
    const CameraOptions& camera = options_.camera;
    frame.index = static_cast<int>(camera_number(camera, index));
    frame.dropped_frames =
        index == 0 ? 0 : frame.index - static_cast<int>(camera_number(camera, index - 1)) - 1;
    frame.shutter = shutter_at(camera, options_.seed, frame.index);
    frame.freeze = freeze_at(camera, frame.index);
    frame.offset_counts = offset_at(camera, options_.seed, shown_at(camera, frame.index));
    frame.events = events_at(camera, options_.seed, index);
    for (std::size_t i = 0; i < world_.objects.size(); ++i) {
      if (world_.objects[i].moves()) {
        frame.moved.push_back(
            {static_cast<int>(i), moved_by(world_.objects[i].motion, seconds(frame.index))});
      }
    }
  }

  // The clean picture at a moment of the camera's clock.
  void look(int number, ImageView<float> clean, ParallelRunner& runner) {
    if (moves_) {
      facets_ = tessellate(world_at(world_, seconds(number)));
    }
    ray_caster_.set_pose(pose_at(world_.view, options_, number), runner);
    imager_.run(ray_caster_, clean, runner);
  }

  SceneOptions options_;
  World world_;
  bool moves_;
  Facets facets_;
  Lens lens_;
  Imager imager_;
  RayCaster ray_caster_;
  Sensor sensor_;
};

Renderer::Renderer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

const SceneOptions& Renderer::options() const { return impl_->options(); }

Result<Renderer> Renderer::create(const SceneOptions& options) {
  return within_memory(options, [&]() -> Result<Renderer> {
    return check(options)
        .and_then([&] { return check_lens(options, Lens(intrinsics_of(options.camera))); })
        .and_then([&] { return find_world(options); })
        .map([&](World world) {
          add_moving_things(options, world);
          return Renderer(std::make_unique<Impl>(options, std::move(world)));
        });
  });
}

Result<TrueFrame> Renderer::render(int index, ParallelRunner& runner) {
  if (index < 0 || index >= options().frames) {
    return failure(ErrorCode::kInvalidArgument, "sim:" + options().name + ": there is no frame " +
                                                    std::to_string(index) + "; frames are 0 to " +
                                                    std::to_string(options().frames - 1));
  }
  return within_memory(options(),
                       [&]() -> Result<TrueFrame> { return impl_->render(index, runner); });
}

Result<TrueFrame> render(const SceneOptions& options, int index) {
  return Renderer::create(options).and_then([&](Renderer renderer) {
    const auto runner = make_runner(1);
    return renderer.render(index, *runner);
  });
}

}  // namespace thermedge::sim
