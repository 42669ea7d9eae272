// SPDX-License-Identifier: Apache-2.0
#include "xml_check.h"

#include <algorithm>
#include <cctype>
#include <set>
#include <vector>

namespace raybundle {
namespace {

bool is_name(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_' || c == ':';
}

/// Every & begins one of XML's own entities.
bool entities_exist(const std::string& text) {
    for (std::size_t at = text.find('&'); at != std::string::npos; at = text.find('&', at + 1)) {
        const std::string entity = text.substr(at, text.find(';', at) - at + 1);
        const std::set<std::string> known = {"&amp;", "&lt;", "&gt;", "&quot;", "&apos;", "&#39;"};
        if (known.count(entity) == 0) {
            return false;
        }
    }
    return true;
}

/// The inside of a tag: name, then attributes. Returns the fault, and the name in `name`.
std::string tag_fault(const std::string& tag, std::string& name) {
    std::size_t at = 0;
    const auto word = [&] {
        const std::size_t begin = at;
        while (at < tag.size() && is_name(tag[at])) {
            ++at;
        }
        return tag.substr(begin, at - begin);
    };
    name = word();
    if (name.empty()) {
        return "a tag without a name: <" + tag + ">";
    }
    std::set<std::string> seen;
    while (at < tag.size()) {
        if (tag[at] != ' ' && tag[at] != '\n') {
            return "no room before an attribute in <" + tag + ">";
        }
        while (at < tag.size() && (tag[at] == ' ' || tag[at] == '\n')) {
            ++at;
        }
        if (at == tag.size()) {
            return "";
        }
        const std::string attribute = word();
        if (attribute.empty() || !seen.insert(attribute).second) {
            return "an attribute without a name, or twice, in <" + tag + ">";
        }
        if (tag.substr(at, 2) != "=\"") {
            return "an attribute without a quoted value in <" + tag + ">";
        }
        const std::size_t end = tag.find('"', at + 2);
        if (end == std::string::npos || !entities_exist(tag.substr(at + 2, end - at - 2))) {
            return "a bad value in <" + tag + ">";
        }
        at = end + 1;
    }
    return "";
}

}  // namespace

std::string xml_fault(const std::string& text) {
    std::vector<std::string> open;
    std::size_t at = 0;
    int roots = 0;
    while (at < text.size()) {
        const std::size_t begin = text.find('<', at);
        const std::string between = text.substr(at, begin - at);
        const bool blank = std::all_of(between.begin(), between.end(),
                                       [](unsigned char c) { return std::isspace(c) != 0; });
        if (!entities_exist(between) || (open.empty() && !blank)) {
            return "bad text: " + between;
        }
        if (begin == std::string::npos) {
            break;
        }
        const std::size_t end = text.find('>', begin);
        if (end == std::string::npos) {
            return "a tag without end";
        }
        std::string tag = text.substr(begin + 1, end - begin - 1);
        at = end + 1;
        if (tag.find('<') != std::string::npos) {
            return "< inside of a tag: " + tag;
        }
        if (!tag.empty() && tag.front() == '/') {
            if (open.empty() || open.back() != tag.substr(1)) {
                return "</" + tag.substr(1) + "> closes nothing";
            }
            open.pop_back();
            continue;
        }
        const bool closed = !tag.empty() && tag.back() == '/';
        if (closed) {
            tag.pop_back();
        }
        std::string name;
        const std::string fault = tag_fault(tag, name);
        if (!fault.empty()) {
            return fault;
        }
        roots += open.empty() ? 1 : 0;
        if (!closed) {
            open.push_back(name);
        }
    }
    if (!open.empty()) {
        return "<" + open.back() + "> is never closed";
    }
    return roots == 1 ? "" : "not one root but " + std::to_string(roots);
}

}  // namespace raybundle
