// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <charconv>
#include <cmath>
#include <ctime>
#include <glm/glm.hpp>

#include "report/bcf.h"
#include "report/xml_reader.h"
#include "report/zip_file.h"

namespace raybundle {
namespace {

constexpr std::size_t longest_text = 500;  // characters of a pin
constexpr std::size_t longest_name = 64;
constexpr std::size_t most_topics = 256;
constexpr int most_comments = 100;
constexpr double looks_far = 3.0;  // m: where a camera without a place on a surface looks

std::string shortened(std::string text, std::size_t characters) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool begins = (static_cast<unsigned char>(text[i]) & 0xc0U) != 0x80U;
        if (begins && ++count > characters) {
            text.resize(i);
            break;
        }
    }
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    const std::size_t last = text.find_last_not_of(" \t\r\n");
    return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

/// Hexadecimal digits and hyphens, as GUIDs have them: they become names of folders.
std::string guid_text(const std::string& text) {
    const bool valid = text.size() == 36 && std::all_of(text.begin(), text.end(), [](char c) {
                           return c == '-' || std::isxdigit(static_cast<unsigned char>(c)) != 0;
                       });
    return valid ? text : "";
}

/// xs:dateTime as Unix time, ms; 0: none.
double time_of(const std::string& date) {
    std::tm t{};
    if (std::sscanf(date.c_str(), "%d-%d-%dT%d:%d:%d", &t.tm_year, &t.tm_mon, &t.tm_mday,
                    &t.tm_hour, &t.tm_min, &t.tm_sec) < 3 ||
        t.tm_year < 1970 || t.tm_year > 3000) {
        return 0.0;
    }
    t.tm_year -= 1900;
    t.tm_mon -= 1;
    double offset = 0.0;
    const std::size_t sign = date.find_last_of("+-");
    int hours = 0;
    int minutes = 0;
    if (sign != std::string::npos && sign > 10 &&
        std::sscanf(date.c_str() + sign + 1, "%d:%d", &hours, &minutes) == 2) {
        offset = (date[sign] == '-' ? -60.0 : 60.0) * (60.0 * hours + minutes);
    }
    return 1000.0 * (static_cast<double>(timegm(&t)) - offset);
}

std::optional<glm::dvec3> vector_of(const XmlElement* element) {
    if (element == nullptr) {
        return std::nullopt;
    }
    glm::dvec3 v;
    const char* const names[] = {"X", "Y", "Z"};
    for (int i = 0; i < 3; ++i) {
        const std::string text = shortened(element->text_of(names[i]), 40);
        const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), v[i]);
        if (error != std::errc() || rest != text.data() + text.size() || !(std::abs(v[i]) <= 1e9)) {
            return std::nullopt;
        }
    }
    return glm::dvec3(v.x, v.z, -v.y);
}

void set(const glm::dvec3& v, v1::Vec3* to) {
    to->set_x(static_cast<float>(v.x));
    to->set_y(static_cast<float>(v.y));
    to->set_z(static_cast<float>(v.z));
}

void read_viewpoint(const XmlElement& root, v1::PinChanged& pin) {
    const XmlElement* camera = root.child("PerspectiveCamera");
    const bool perspective = camera != nullptr;
    camera = perspective ? camera : root.child("OrthogonalCamera");
    if (camera == nullptr) {
        return;
    }
    const auto eye = vector_of(camera->child("CameraViewPoint"));
    const auto direction = vector_of(camera->child("CameraDirection"));
    const auto up = vector_of(camera->child("CameraUpVector"));
    if (!eye || !direction || !(glm::length(*direction) > 1e-6)) {
        return;
    }
    const glm::dvec3 target = *eye + looks_far * glm::normalize(*direction);
    set(*eye, pin.mutable_camera()->mutable_eye());
    set(target, pin.mutable_camera()->mutable_target());
    set(up.value_or(glm::dvec3(0.0, 1.0, 0.0)), pin.mutable_camera()->mutable_up());
    double degrees = 60.0;
    const std::string field = camera->text_of("FieldOfView");
    std::from_chars(field.data(), field.data() + field.size(), degrees);
    pin.mutable_camera()->set_vertical_fov(
        static_cast<float>(glm::radians(std::clamp(degrees, 1.0, 170.0))));
    set(target, pin.mutable_position());
}

std::uint32_t number_in(const XmlElement& topic) {
    const XmlElement* const list = topic.child("Labels");
    for (const XmlElement& label : (list != nullptr ? list : &topic)->children) {
        if (label.text.starts_with("pin ")) {
            std::uint32_t number = 0;
            std::from_chars(label.text.data() + 4, label.text.data() + label.text.size(), number);
            return number;
        }
    }
    return 0;
}

/// Comments are in the topic since 3.0, before it beside it.
void read_comments(const XmlElement& parent, v1::PinChanged& pin) {
    for (const XmlElement& comment : parent.children) {
        const std::string text = shortened(comment.text_of("Comment"), longest_text);
        if (comment.name != "Comment" || text.empty() || pin.replies_size() >= most_comments) {
            continue;
        }
        v1::PinReply& reply = *pin.add_replies();
        reply.set_text(text);
        reply.set_by_name(shortened(comment.text_of("Author"), longest_name));
        reply.set_at_ms(time_of(comment.text_of("Date")));
        const auto guid = comment.attributes.find("Guid");
        reply.set_guid(guid == comment.attributes.end() ? "" : guid_text(guid->second));
    }
}

std::optional<v1::PinChanged> read_topic(const XmlElement& root) {
    const XmlElement* const topic = root.child("Topic");
    if (root.name != "Markup" || topic == nullptr) {
        return std::nullopt;
    }
    v1::PinChanged pin;
    const auto attribute = [&](const char* name) {
        const auto found = topic->attributes.find(name);
        return found == topic->attributes.end() ? std::string() : found->second;
    };
    const std::string title = topic->text_of("Title");
    const std::string description = topic->text_of("Description");
    // What write_bcf() has made begins with its title; others' descriptions do not repeat it.
    pin.set_text(shortened(description.empty() || description.starts_with(title)
                               ? (description.empty() ? title : description)
                               : title + "\n" + description,
                           longest_text));
    if (pin.text().empty()) {
        pin.set_text("(no text)");
    }
    std::string status = attribute("TopicStatus");
    std::transform(status.begin(), status.end(), status.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    pin.set_resolved(status == "closed" || status == "resolved" || status == "done");
    pin.set_guid(guid_text(attribute("Guid")));
    pin.set_by_name(shortened(topic->text_of("CreationAuthor"), longest_name));
    pin.set_assigned_to(shortened(topic->text_of("AssignedTo"), longest_name));
    pin.set_set_at_ms(time_of(topic->text_of("CreationDate")));
    pin.set_pin(number_in(*topic));
    const XmlElement* const comments = topic->child("Comments");
    read_comments(comments != nullptr ? *comments : root, pin);
    return pin;
}

}  // namespace

std::optional<std::vector<v1::PinChanged>> read_bcf(std::string_view bytes, std::string& reason) {
    const auto entries = read_zip(bytes, {}, reason);
    if (!entries) {
        return std::nullopt;
    }
    if (!entries->contains("bcf.version")) {
        reason = "it has no bcf.version: it is no BCF archive";
        return std::nullopt;
    }
    std::vector<v1::PinChanged> pins;
    for (const auto& [name, contents] : *entries) {
        constexpr std::string_view ending = "/markup.bcf";
        if (!name.ends_with(ending)) {
            continue;
        }
        const std::string folder = name.substr(0, name.size() - ending.size());
        const auto root = read_xml(contents);
        auto pin = root ? read_topic(*root) : std::nullopt;
        if (!pin) {
            reason = name + ": it is not a markup of BCF";
            return std::nullopt;
        }
        if (pins.size() >= most_topics) {
            reason = "it has more than 256 topics";
            return std::nullopt;
        }
        for (auto view = entries->lower_bound(folder + "/");
             view != entries->end() && view->first.starts_with(folder + "/"); ++view) {
            const auto info = view->first.ends_with(".bcfv") && !pin->has_camera()
                                  ? read_xml(view->second)
                                  : std::nullopt;
            if (info && info->name == "VisualizationInfo") {
                read_viewpoint(*info, *pin);
            }
        }
        pins.push_back(std::move(*pin));
    }
    return pins;
}

}  // namespace raybundle
