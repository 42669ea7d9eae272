// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <cmath>
#include <ctime>
#include <glm/glm.hpp>
#include <set>

#include "report/bcf.h"
#include "report/html_text.h"
#include "report/zip_file.h"
#include "scene/mix_bits.h"

namespace raybundle {
namespace {

constexpr const char* xml_head = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";

std::uint64_t hash_of(const std::string& text, std::uint64_t seed) {
    std::uint64_t hash = 14695981039346656037ULL ^ seed;  // FNV-1a
    for (const char c : text) {
        hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
    }
    return hash;
}

/// Of the form of RFC 9562, version 8: made of a name.
std::string guid_of(const std::string& name) {
    const std::uint64_t a = hash_of(name, 1);
    const std::uint64_t b = hash_of(name, 2);
    return fmt::format("{:08x}-{:04x}-8{:03x}-{:04x}-{:012x}", a >> 32U, a >> 16U & 0xffffU,
                       a & 0xfffU, 0x8000U | (b >> 48U & 0x3fffU), b & 0xffffffffffffULL);
}

/// xs:dateTime.
std::string date_of(double unix_ms) {
    const auto seconds = static_cast<std::time_t>(std::floor(unix_ms / 1000.0));
    std::tm t{};
    if (!(std::abs(unix_ms) < 1e14) || gmtime_r(&seconds, &t) == nullptr) {
        return "1970-01-01T00:00:00Z";
    }
    return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z", t.tm_year + 1900, t.tm_mon + 1,
                       t.tm_mday, t.tm_hour, t.tm_min, t.tm_sec);
}

std::string author_of(const std::string& name) {
    return escaped(name.empty() ? "somebody" : name);
}

/// BCF's axes.
std::string vector_xml(const char* name, const glm::dvec3& v) {
    return fmt::format("<{0}><X>{1:.6f}</X><Y>{2:.6f}</Y><Z>{3:.6f}</Z></{0}>", name, v.x, -v.z,
                       v.y);
}

glm::dvec3 from(const v1::Vec3& v) {
    return {v.x(), v.y(), v.z()};
}

std::string first_line(const std::string& text) {
    return text.substr(0, text.find('\n'));
}

std::string markup(const v1::PinChanged& pin, const std::string& guid, const std::string& view) {
    const std::string date = date_of(pin.set_at_ms());
    std::string xml = xml_head;
    xml += fmt::format(
        "<Markup><Topic Guid=\"{}\" TopicType=\"Lighting\" TopicStatus=\"{}\">"
        "<Title>{}</Title><Index>{}</Index><Labels><Label>pin {}</Label></Labels>"
        "<CreationDate>{}</CreationDate><CreationAuthor>{}</CreationAuthor>",
        guid, pin.resolved() ? "Closed" : "Open", escaped(first_line(pin.text())), pin.pin(),
        pin.pin(), date, author_of(pin.by_name()));
    if (!pin.assigned_to().empty()) {
        xml += "<AssignedTo>" + escaped(pin.assigned_to()) + "</AssignedTo>";
    }
    xml += "<Description>" + escaped(pin.text()) + "</Description><Comments>";
    for (int i = 0; i < pin.replies_size(); ++i) {
        const v1::PinReply& reply = pin.replies(i);
        xml += fmt::format(
            "<Comment Guid=\"{}\"><Date>{}</Date><Author>{}</Author><Comment>{}</Comment>"
            "<Viewpoint Guid=\"{}\"/></Comment>",
            escaped(bcf_reply_guid(guid, pin, i)), date_of(reply.at_ms()),
            author_of(reply.by_name()), escaped(reply.text()), view);
    }
    xml += fmt::format(
        "</Comments><Viewpoints><ViewPoint Guid=\"{}\"><Viewpoint>viewpoint.bcfv"
        "</Viewpoint><Index>0</Index></ViewPoint></Viewpoints></Topic></Markup>\n",
        view);
    return xml;
}

/// What who set the pin looked from; without that from 3 m in front of it.
std::string viewpoint(const v1::PinChanged& pin, const std::string& guid) {
    const glm::dvec3 place = from(pin.position());
    glm::dvec3 eye = place + glm::dvec3(0.0, 1.0, 3.0);
    glm::dvec3 up(0.0, 1.0, 0.0);
    double degrees = 60.0;
    if (pin.has_camera() && glm::distance(from(pin.camera().eye()), place) > 1e-6) {
        eye = from(pin.camera().eye());
        up = from(pin.camera().up());
        degrees = glm::degrees(static_cast<double>(pin.camera().vertical_fov()));
    }
    const glm::dvec3 forward = glm::normalize(place - eye);
    glm::dvec3 aside = glm::cross(forward, up);
    if (!(glm::length(aside) > 1e-6)) {
        aside = glm::cross(forward, glm::dvec3(1.0, 0.0, 0.1));
    }
    const glm::dvec3 upright = glm::normalize(glm::cross(aside, forward));
    return fmt::format(
        "{}<VisualizationInfo Guid=\"{}\"><PerspectiveCamera>{}{}{}<FieldOfView>{:.4f}"
        "</FieldOfView><AspectRatio>1.3333</AspectRatio></PerspectiveCamera></VisualizationInfo>\n",
        xml_head, guid, vector_xml("CameraViewPoint", eye), vector_xml("CameraDirection", forward),
        vector_xml("CameraUpVector", upright), std::clamp(degrees, 1.0, 179.0));
}

/// What values topics have: BCF 3.0 wants them listed.
std::string extensions(const std::vector<v1::PinChanged>& pins) {
    std::set<std::string> users;
    std::string labels;
    for (const v1::PinChanged& pin : pins) {
        users.insert(author_of(pin.by_name()));
        if (!pin.assigned_to().empty()) {
            users.insert(escaped(pin.assigned_to()));
        }
        for (const v1::PinReply& reply : pin.replies()) {
            users.insert(author_of(reply.by_name()));
        }
        labels += fmt::format("<TopicLabel>pin {}</TopicLabel>", pin.pin());
    }
    std::string list;
    for (const std::string& user : users) {
        list += "<User>" + user + "</User>";
    }
    return std::string(xml_head) +
           "<Extensions><TopicTypes><TopicType>Lighting</TopicType></TopicTypes><TopicStatuses>"
           "<TopicStatus>Open</TopicStatus><TopicStatus>Closed</TopicStatus></TopicStatuses>"
           "<TopicLabels>" +
           labels + "</TopicLabels><Users>" + list + "</Users></Extensions>\n";
}

}  // namespace

std::string bcf_guid(const v1::PinChanged& pin, const std::string& project) {
    return pin.guid().empty()
               ? guid_of(fmt::format("{} pin {} {:.0f}", project, pin.pin(), pin.set_at_ms()))
               : pin.guid();
}

std::string bcf_reply_guid(const std::string& guid, const v1::PinChanged& pin, int reply) {
    const std::string& own = pin.replies(reply).guid();
    return own.empty() ? guid_of(guid + fmt::format(" reply {}", reply)) : own;
}

std::string write_bcf(const std::vector<v1::PinChanged>& pins, const std::string& project) {
    ZipEntries entries;
    entries["bcf.version"] = std::string(xml_head) + "<Version VersionId=\"3.0\"/>\n";
    entries["project.bcfp"] = std::string(xml_head) + "<ProjectInfo><Project ProjectId=\"" +
                              guid_of(project) + "\"><Name>" + escaped(project) +
                              "</Name></Project></ProjectInfo>\n";
    entries["extensions.xml"] = extensions(pins);
    for (const v1::PinChanged& pin : pins) {
        const std::string guid = bcf_guid(pin, project);
        const std::string view = guid_of(guid + " viewpoint");
        entries[guid + "/markup.bcf"] = markup(pin, guid, view);
        entries[guid + "/viewpoint.bcfv"] = viewpoint(pin, view);
    }
    return write_zip(entries);
}

}  // namespace raybundle
