// SPDX-License-Identifier: Apache-2.0
#include "session/measure/requirement_board.h"

#include <utility>

namespace raybundle {
namespace {

/// Rows of EN 12464-1:2021 to begin with.
v1::Requirement row(const char* name, float mean, float uniformity, float glare, float cylindrical,
                    float wall) {
    v1::Requirement r;
    r.set_name(name);
    r.set_mean(mean);
    r.set_uniformity(uniformity);
    r.set_glare(glare);
    r.set_colour_rendering(80.0F);
    if (cylindrical > 0.0F) {
        r.set_cylindrical(cylindrical);
    }
    if (wall > 0.0F) {
        r.set_vertical(wall);
    }
    return r;
}

std::map<std::string, v1::Requirement> examples() {
    std::map<std::string, v1::Requirement> rows;
    for (const v1::Requirement& r :
         {row("Office: writing, reading", 500.0F, 0.6F, 19.0F, 150.0F, 150.0F),
          row("Office: filing, copying", 300.0F, 0.4F, 19.0F, 100.0F, 100.0F),
          row("Corridor", 100.0F, 0.4F, 28.0F, 50.0F, 50.0F),
          row("Classroom", 500.0F, 0.6F, 19.0F, 150.0F, 150.0F)}) {
        rows[r.name()] = r;
    }
    return rows;
}

constexpr std::uint32_t the_note = 1;

}  // namespace

RequirementBoard::RequirementBoard(ChangeLog& log) : log_(log), rows_(examples()) {
    for (const std::string& body : log.notes(NoteKind::requirements)) {
        restore(body);
    }
}

void RequirementBoard::restore(const std::string& body) {
    v1::JournalRequirements stored;
    if (!stored.ParseFromString(body)) {
        return;
    }
    rows_.clear();
    for (const v1::Requirement& r : stored.requirements()) {
        if (!r.name().empty()) {
            rows_[r.name()] = r;
        }
    }
}

bool RequirementBoard::refuse(v1::Error::Code code, const std::string& reason) {
    refusal_.set_code(code);
    refusal_.set_message(reason);
    return false;
}

bool RequirementBoard::keep(std::map<std::string, v1::Requirement> rows) {
    v1::JournalRequirements stored;
    for (const auto& [name, r] : rows) {
        *stored.add_requirements() = r;
    }
    std::string body = stored.SerializeAsString();
    if (body.empty()) {  // an empty note is no note: an empty row stands for none
        stored.add_requirements();
        body = stored.SerializeAsString();
    }
    if (!log_.keep_note(NoteKind::requirements, the_note, body)) {
        refusal_ = log_.refusal("the requirements could not be saved");
        return false;
    }
    rows_ = std::move(rows);
    return true;
}

bool RequirementBoard::set(const v1::Requirement& r) {
    std::map<std::string, v1::Requirement> rows = rows_;
    rows[r.name()] = r;
    if (rows.size() > most_rows) {
        return refuse(v1::Error::RESOURCE_EXHAUSTED, "setRequirement: there are 256, remove some");
    }
    return keep(std::move(rows));
}

bool RequirementBoard::remove(const std::string& name) {
    std::map<std::string, v1::Requirement> rows = rows_;
    if (rows.erase(name) == 0) {
        return refuse(v1::Error::NOT_FOUND,
                      "removeRequirement.name: no requirement '" + name + "'");
    }
    return keep(std::move(rows));
}

Requirement RequirementBoard::required(const std::string& name, Quantity quantity) const {
    Requirement required;
    const auto found = rows_.find(name);
    if (found == rows_.end()) {
        return required;
    }
    const v1::Requirement& r = found->second;
    const auto take = [](bool given, float value, std::optional<double>& to) {
        if (given) {
            to = static_cast<double>(value);
        }
    };
    switch (quantity) {
        case Quantity::vertical:
            take(r.has_vertical(), r.vertical(), required.mean);
            break;
        case Quantity::cylindrical:
            take(r.has_cylindrical(), r.cylindrical(), required.mean);
            break;
        case Quantity::semicylindrical:  // a row has Ez, which is another quantity
            break;
        case Quantity::daylight_factor:
            take(r.has_daylight_factor(), r.daylight_factor(), required.mean);
            break;
        case Quantity::ugr:
            take(r.has_glare(), r.glare(), required.most);
            break;
        case Quantity::dgp:
            take(r.has_daylight_glare(), r.daylight_glare(), required.most);
            break;
        default:
            take(r.has_mean(), r.mean(), required.mean);
            take(r.has_uniformity(), r.uniformity(), required.uniformity);
            take(r.has_colour_rendering(), r.colour_rendering(), required.colour_rendering);
    }
    return required;
}

}  // namespace raybundle
