// SPDX-License-Identifier: Apache-2.0
#include "view/specular/specular_view.h"

#include <algorithm>
#include <utility>

#include "gpu/gl_scope.h"

namespace raybundle {

SpecularView::SpecularView(const GpuScene& scene, const RadianceStore& store,
                           const ViewPrograms& programs)
    : scene_(scene),
      store_(store),
      programs_(programs),
      ends_("continued pixels", sizeof(layout::ContinuedPixel)),
      radiance_("continued radiance", sizeof(glm::vec4)) {}

/// Room for so many tiles, with a quarter to spare; smaller again where half of it would do.
void SpecularView::choose_size(unsigned columns, unsigned rows) {
    if (columns == columns_ && rows <= rows_ && (2 * rows >= rows_ || rows_ <= 2)) {
        return;
    }
    columns_ = columns;
    rows_ = rows + rows / 4;
    pixels_.reset();
    const std::size_t pixels = std::size_t{columns_} * rows_ * VIEW_TILE * VIEW_TILE;
    ends_ = Buffer("continued pixels", pixels * sizeof(layout::ContinuedPixel));
    radiance_ = Buffer("continued radiance", pixels * sizeof(glm::vec4));
}

void SpecularView::refresh(const layout::ViewParameters& view, const Camera& camera, float near,
                           float kept_weight) {
    const GlScope scope("view rays behind mirrors");
    ContinuedEnds found = find_continued_ends(*scene_.specular_rays(), view, camera.hidden);
    const unsigned columns = (view.size.x + VIEW_TILE - 1) / VIEW_TILE;
    const auto rows = static_cast<unsigned>((found.tile_count() + columns - 1) / columns);
    const unsigned old_columns = columns_;
    choose_size(columns, rows);
    if (pixels_) {
        match_ends(found, found_, old_columns);
    }
    std::vector<std::uint32_t> table = {columns_};
    table.insert(table.end(), found.tiles.begin(), found.tiles.end());
    if (tiles_.bytes() != table.size() * sizeof(std::uint32_t)) {
        tiles_ = Buffer("continued tiles", table.size() * sizeof(std::uint32_t));
    }
    tiles_.write<std::uint32_t>(table, 0);
    found_ = std::move(found);
    if (rows == 0) {
        pixels_.reset();
        rows_ = 0;
        return;
    }
    ends_.write<layout::ContinuedPixel>(in_rows(found_, columns_, rows_), 0);
    if (!pixels_) {
        pixels_.emplace(scene_, store_, programs_,
                        unsigned{VIEW_TILE} * glm::uvec2(columns_, rows_));
    }
    pixels_->show_ends(ends_, camera, near, kept_weight);
}

void SpecularView::shade() {
    if (pixels_) {
        pixels_->light_vertices();
        pixels_->set_display({1.0F, 1.0F, 0.0F, 0.0F});
        pixels_->write_radiance(radiance_);
    }
}

void SpecularView::bind() const {
    tiles_.bind_storage(BINDING_CONTINUED_TILES);
    ends_.bind_storage(BINDING_CONTINUED);
    radiance_.bind_storage(BINDING_CONTINUED_RADIANCE);
}

std::size_t SpecularView::bytes() const {
    return tiles_.bytes() + ends_.bytes() + radiance_.bytes() + (pixels_ ? pixels_->bytes() : 0);
}

}  // namespace raybundle
