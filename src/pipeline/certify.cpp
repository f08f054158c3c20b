#include "unsnarl/certify.h"

#include <optional>
#include <utility>

#include "geometry/parallel.h"
#include "mesh/areas.h"
#include "mesh/validity.h"
#include "scene/face_pairs.h"
#include "scene/output_format.h"
#include "scene/prepared_surface.h"

namespace unsnarl {

class Certifier::Search {
 public:
  Search(const SurfaceView& input, const FindOptions& options)
      : input_(input), options_(options), prepared_(prepare(input, options)), finder_(prepared_) {}
  // The finder refers to the prepared surface.
  Search(const Search&) = delete;
  Search& operator=(const Search&) = delete;

  /// As the input's polygons are cut, and as a program cuts them that reads these positions.
  std::vector<IntersectingPair> pairs_at(std::span<const double> positions) {
    require_positions(input_, positions);
    const Positions x = at_own_scale(positions);
    std::vector<IntersectingPair> pairs = finder_.find(x);
    const std::optional<PreparedSurface> read = cut_anew(input_, prepared_, options_, positions);
    return read ? unite_face_pairs(std::move(pairs), FacePairFinder(*read).find(x)) : pairs;
  }

  std::vector<IntersectingPair> allowed_pairs_at(std::span<const double> positions) const {
    require_positions(input_, positions);
    return unsnarl::find_allowed_pairs(prepared_, cut_anew(input_, prepared_, options_, positions),
                                       at_own_scale(positions));
  }

  Certificate certify(std::span<const double> positions) {
    Certificate certificate;
    certificate.pairs = count_by_class(pairs_at(positions));
    certificate.allowed = count_by_class(allowed_pairs_at(positions));
    certificate.seams_closed = options_.weld_tolerance > 0 || prepared_.seams_are_closed(positions);
    certificate.new_zero_area_faces = count_lost_areas(prepared_.rest, at_own_scale(positions), prepared_.triangles());
    return certificate;
  }

  PairCounts pairs_in_float32(std::span<const double> positions) {
    const Positions as_is = Eigen::Map<const Positions>(positions.data(), 3, static_cast<Index>(positions.size() / 3));
    const Positions rounded = rounded_to_float32(as_is, {});
    const std::span<const double> values(rounded.data(), positions.size());
    PairCounts pairs = count_by_class(pairs_at(values));
    if (!fits_float32(as_is, {})) ++pairs[PairClass::degenerate];
    return pairs;
  }

  int threads() const { return options_.threads; }

 private:
  /// Exactly, whatever numbers they are; what meets does so at any scale.
  Positions at_own_scale(std::span<const double> positions) const {
    return prepared_.gather(positions, Scale(positions));
  }

  SurfaceView input_;
  FindOptions options_;
  PreparedSurface prepared_;
  FacePairFinder finder_;
};

Certifier::Certifier(const SurfaceView& input, const FindOptions& options) {
  const ThreadLimit threads(options.threads);
  search_ = std::make_unique<Search>(input, options);
}
Certifier::Certifier(Certifier&&) noexcept = default;
Certifier& Certifier::operator=(Certifier&&) noexcept = default;
Certifier::~Certifier() = default;

std::vector<IntersectingPair> Certifier::find_intersections(std::span<const double> positions) {
  const ThreadLimit threads(search_->threads());
  return search_->pairs_at(positions);
}

std::vector<IntersectingPair> Certifier::find_allowed_pairs(std::span<const double> positions) {
  const ThreadLimit threads(search_->threads());
  return search_->allowed_pairs_at(positions);
}

Certificate Certifier::certify(std::span<const double> positions) {
  const ThreadLimit threads(search_->threads());
  return search_->certify(positions);
}

PairCounts Certifier::pairs_in_float32(std::span<const double> positions) {
  const ThreadLimit threads(search_->threads());
  return search_->pairs_in_float32(positions);
}

Certificate certify(const SurfaceView& input, std::span<const double> positions, const FindOptions& options) {
  Certifier certifier(input, options);
  Certificate certificate = certifier.certify(positions);
  certificate.pairs_float32 = certifier.pairs_in_float32(positions);
  return certificate;
}

}  // namespace unsnarl
