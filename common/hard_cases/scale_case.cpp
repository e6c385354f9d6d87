#include "common/hard_cases/scale_case.h"

#include <cmath>

#include "common/hard_cases/image_difference.h"
#include "common/hard_cases/tiny_scenes.h"

namespace relight::hard {

namespace {

Relit relit_at(float scale, const std::function<std::unique_ptr<Method>()>& make, const KnobList& knobs) {
  MethodBench bench(make(), tiny::room(2.0f * scale), knobs);
  const glm::vec3 power(scale * scale);
  return bench.relight(
      {},
      tiny::lighting({tiny::omni(scale * glm::vec3(0.3f, 0.6f, 0.4f), power),
                      tiny::spot(scale * glm::vec3(-0.4f, 0.9f, 0.3f), {0.3f, -1.0f, 0.1f}, 15, 25, power)}));
}

}  // namespace

Case scale_case(std::function<std::unique_ptr<Method>()> make, KnobList knobs, double bound,
                std::string why) {
  const auto measure = [make = std::move(make), knobs = std::move(knobs), bound, why = std::move(why)] {
    const Relit original = relit_at(1.0f, make, knobs);
    Figures figures;
    for (const float scale : {0x1p-10f, 0x1p10f}) {
      const Relit scaled = relit_at(scale, make, knobs);
      add_worst(figures,
                at_most("1/1024 and 1024: relative difference of indirect light",
                        relative_difference(scaled.indirect, original.indirect), 1e-3,
                        "powers of two change no bit of a mantissa: nothing but absolute lengths can"));
    }
    for (const float scale : {1e-3f, 1e3f}) {
      const Relit scaled = relit_at(scale, make, knobs);
      add_worst(figures, at_most("1/1000 and 1000: relative difference of direct light",
                                 relative_difference(scaled.direct, original.direct), 1e-3,
                                 "a sub-sample may change sides at the edge of a shadow; most don't"));
      add_worst(figures,
                at_most("1/1000 and 1000: change of the norm of indirect light",
                        std::abs(norm(scaled.indirect) / norm(original.indirect) - 1.0), bound, why));
    }
    return figures;
  };
  return {"scenes of a thousandth and a thousand times the size",
          "An absolute epsilon, clamp or search radius shows at another unit of length.", measure};
}

}  // namespace relight::hard
