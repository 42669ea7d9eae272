// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace raybundle {

/// An element of XML: its name without prefix, what is in it.
struct XmlElement {
    std::string name;
    std::map<std::string, std::string> attributes;
    std::string text;  ///< without that of its children
    std::vector<XmlElement> children;

    /// The first child of that name; null: none.
    [[nodiscard]] const XmlElement* child(std::string_view name) const;
    /// Its text; empty where there is none.
    [[nodiscard]] std::string text_of(std::string_view name) const;
};

/// The root element of a document. Entities but the five of XML and numbers are refused, and so is
/// a document type, which might define others. Nothing where it is not well-formed, deeper than 32
/// elements or has more than 100 000 of them.
std::optional<XmlElement> read_xml(std::string_view text);

}  // namespace raybundle
