// SPDX-License-Identifier: Apache-2.0
#include "solution/store/shooter_selection.h"

#include <algorithm>

namespace raybundle {

namespace {
constexpr std::size_t max_shooters = 16;
}  // namespace

ShooterSelection::ShooterSelection(const GpuScene& scene)
    : patch_count_(scene.patch_count()),
      block_count_((scene.patch_count() + POWER_BLOCK - 1) / POWER_BLOCK),
      power_("power blocks", (std::size_t{block_count_} + 1) * sizeof(glm::vec4)),
      flux_("flux sums", (std::size_t{block_count_} + 1) * sizeof(layout::FluxSums)),
      balance_("energy balance", sizeof(layout::Balance)),
      cdf_("selection cdf", std::size_t{patch_count_} * sizeof(float)),
      shooters_("shooters", max_shooters * sizeof(layout::Shooter)),
      readback_("shooter readback", max_shooters * sizeof(layout::Shooter)),
      power_sum_({"solution_power_sum.comp"}, scene.defines()),
      power_scan_({"solution_power_scan.comp"}),
      power_density_({"solution_power_density.comp"}, scene.defines()),
      choose_({"solution_shooters.comp"}, scene.defines()),
      flux_sum_({"solution_flux_sum.comp"}, scene.defines()),
      balance_flux_({"solution_balance.comp"}) {
    balance_.clear();
    flux_.clear();
}

void ShooterSelection::bind() const {
    power_.bind_storage(BINDING_POWER);
    balance_.bind_storage(BINDING_BALANCE);
    cdf_.bind_storage(BINDING_CDF);
    shooters_.bind_storage(BINDING_SHOOTERS);
}

void ShooterSelection::balance_constant() const {
    flux_.bind_storage(BINDING_FLUX);
    flux_sum_.set("patch_count", patch_count_);
    flux_sum_.dispatch(patch_count_);
    balance_flux_.set("block_count", block_count_);
    balance_flux_.set("shoots_only", shoots_only_ ? 1 : 0);
    balance_flux_.dispatch(1);
}

void ShooterSelection::refresh() const {
    power_sum_.set("patch_count", patch_count_);
    power_sum_.dispatch(patch_count_);
    power_scan_.set("block_count", block_count_);
    power_scan_.dispatch(1);
    power_density_.set("patch_count", patch_count_);
    power_density_.set("block_count", block_count_);
    power_density_.dispatch(patch_count_);
}

std::vector<layout::Shooter> ShooterSelection::choose(std::span<const glm::vec4> numbers,
                                                      float diameter) {
    const std::size_t count = std::min(numbers.size(), max_shooters);
    if (count == 0) {
        return {};
    }
    choose_.set("patch_count", patch_count_);
    choose_.set("block_count", block_count_);
    choose_.set("diameter", diameter);
    choose_.set("shooter_count", static_cast<unsigned>(count));
    choose_.set("random_numbers", numbers.first(count));
    choose_.dispatch(count);
    readback_.request(shooters_, count * sizeof(layout::Shooter));
    const auto chosen = readback_.take_as<layout::Shooter>();
    return {chosen.begin(), chosen.end()};
}

}  // namespace raybundle
