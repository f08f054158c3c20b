#include "report/recorded_frames.h"

#include <algorithm>
#include <utility>

#include "geometry/sort_unique.h"

namespace unsnarl {
namespace {

using Track = Recorder::Stage::Track;

/// Memory for the displacements of all frames together (unit: bytes)
constexpr std::size_t frame_budget = std::size_t{512} << 20;

/// As RecordedFrame, of the vertices of the scene.
struct Frame {
  std::string phase, strategy;
  int iteration = 0;
  std::vector<Index> vertices;
  std::vector<Vec3> displacements;
};

/// Turns stages into frames.
class Film {
 public:
  Film(const Positions& input, int most) : input_(input), most_(static_cast<std::size_t>(most)), now_(input) {
    frames_.push_back({"input", "", 0, {}, {}});
  }

  void play(const Recorder::Stage& stage) {
    if (stage.tracks.empty()) return;
    // A track plays in the first layer after all those that it overlaps.
    std::vector<std::vector<const Track*>> layers;
    std::vector<std::size_t> next_layer(input_.cols(), 0);
    for (const Track& track : stage.tracks) {
      std::size_t layer = 0;
      for (Index v : track.vertices) layer = std::max(layer, next_layer[v]);
      for (Index v : track.vertices) next_layer[v] = layer + 1;
      if (layer == layers.size()) layers.emplace_back();
      layers[layer].push_back(&track);
    }
    for (const auto& layer : layers) play(stage.phase, layer);
  }

  std::vector<Frame> end(const Positions& result) {
    for (Index v = 0; v < input_.cols(); ++v) move(v, result.col(v));
    shoot({"result", "", 0, {}, {}});
    return std::move(frames_);
  }

 private:
  void play(const std::string& phase, const std::vector<const Track*>& tracks) {
    int last = 0;
    for (const Track* track : tracks) last = std::max(last, track->states.back().iteration);
    std::vector<std::size_t> position(tracks.size(), 0);
    for (int iteration = 0; iteration <= last; ++iteration) {
      bool moved = false;
      for (std::size_t k = 0; k < tracks.size(); ++k) {
        const Track& track = *tracks[k];
        if (position[k] == track.states.size() || track.states[position[k]].iteration != iteration) continue;
        const Positions& x = track.states[position[k]++].x;
        for (std::size_t i = 0; i < track.vertices.size(); ++i)
          moved |= move(track.vertices[i], x.col(static_cast<Index>(i)));
      }
      if (!moved || ++moments_ % stride_ != 0) continue;
      shoot({phase, tracks[0]->strategy, iteration, {}, {}});
      // One place is kept for the result.
      while (frames_.size() > 1 && (frames_.size() >= most_ || bytes_ > frame_budget)) thin_out();
    }
  }

  bool move(Index v, const Vec3& to) {
    if (now_.col(v) == to) return false;
    now_.col(v) = to;
    touched_.push_back(v);
    return true;
  }

  /// Appends a frame of the current positions.
  void shoot(Frame frame) {
    sort_unique(touched_);
    frame.vertices = std::exchange(touched_, {});
    for (Index v : frame.vertices) frame.displacements.push_back(now_.col(v) - input_.col(v));
    bytes_ += frame.vertices.size() * sizeof(Vec3);
    frames_.push_back(std::move(frame));
  }

  /// Leaves out every second frame; what moved in it moves in the next.
  void thin_out() {
    std::vector<Frame> kept;
    bytes_ = 0;
    Frame left_out;
    for (std::size_t k = 0; k < frames_.size(); ++k) {
      if (k % 2 == 1) {
        left_out = std::move(frames_[k]);
        continue;
      }
      kept.push_back(joined(std::exchange(left_out, {}), std::move(frames_[k])));
      bytes_ += kept.back().vertices.size() * sizeof(Vec3);
    }
    touched_.insert(touched_.end(), left_out.vertices.begin(), left_out.vertices.end());
    frames_ = std::move(kept);
    stride_ *= 2;
  }

  static Frame joined(Frame first, Frame second) {
    Frame both{std::move(second.phase), std::move(second.strategy), second.iteration, {}, {}};
    std::size_t i = 0, j = 0;
    while (i < first.vertices.size() || j < second.vertices.size()) {
      const bool from_second =
          i == first.vertices.size() || (j < second.vertices.size() && second.vertices[j] <= first.vertices[i]);
      if (from_second && i < first.vertices.size() && first.vertices[i] == second.vertices[j]) ++i;
      const Frame& source = from_second ? second : first;
      std::size_t& at = from_second ? j : i;
      both.vertices.push_back(source.vertices[at]);
      both.displacements.push_back(source.displacements[at]);
      ++at;
    }
    return both;
  }

  const Positions& input_;
  std::size_t most_;
  Positions now_;
  std::vector<Frame> frames_;
  std::vector<Index> touched_;  // since the last frame
  std::size_t moments_ = 0, stride_ = 1;
  std::size_t bytes_ = 0;  // of the displacements in all frames
};

}  // namespace

std::vector<RecordedFrame> recorded_frames(const Recorder& recorder, const SurfaceView& surface,
                                           const PreparedSurface& prepared, std::span<const double> result,
                                           PairCensus& census) {
  if (recorder.options().frames == 0) return {};
  const Positions& input = recorder.input();
  const Positions end = prepared.gather(result);
  Film film(input, recorder.options().frames);
  for (const auto& stage : recorder.stages()) film.play(*stage);
  const std::vector<Frame> shot = film.end(end);

  std::vector<std::vector<Index>> copies(input.cols());
  for (std::size_t v = 0; v < surface.vertex_count(); ++v)
    copies[prepared.weld_map.vertex_of[v]].push_back(static_cast<Index>(v));
  Positions x = input;
  std::vector<RecordedFrame> frames;
  for (const Frame& frame : shot) {
    RecordedFrame& out = frames.emplace_back();
    out.phase = frame.phase;
    out.strategy = frame.strategy;
    out.iteration = frame.iteration;
    std::vector<std::pair<Index, Vec3>> moved;
    for (std::size_t k = 0; k < frame.vertices.size(); ++k) {
      const Index v = frame.vertices[k];
      const Vec3& displacement = frame.displacements[k];
      x.col(v) = input.col(v) + displacement;
      // Copies that are only nearly at one place (welding with a tolerance) come together when they move.
      for (Index copy : copies[v]) {
        Vec3 own = Vec3::Zero();
        for (int i = 0; i < 3; ++i)
          if (displacement[i] != 0)
            own[i] = prepared.scale.out(
                displacement[i] +
                (input(i, v) - prepared.scale.in(surface.positions[3 * static_cast<std::size_t>(copy) + i])));
        moved.emplace_back(copy, own);
      }
    }
    std::sort(moved.begin(), moved.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [v, displacement] : moved) {
      out.vertices.push_back(v);
      out.displacements.insert(out.displacements.end(), displacement.begin(), displacement.end());
    }
    const bool is_result = &frame == &shot.back();
    const PairCensus::Pairs pairs = census.at(is_result ? end : x);
    out.pairs = pairs.faces.total();
    out.allowed = census.allowed_at(is_result ? end : x).total();
    for (const IntersectingPair& pair : pairs.of_faces)
      out.intersecting.insert(out.intersecting.end(), {pair.a, pair.b});
    sort_unique(out.intersecting);
  }
  return frames;
}

}  // namespace unsnarl
