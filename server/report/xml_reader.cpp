// SPDX-License-Identifier: Apache-2.0
#include "report/xml_reader.h"

#include <charconv>
#include <cstdint>

namespace raybundle {
namespace {

constexpr int deepest_element = 32;
constexpr int most_elements = 100'000;

bool is_xml_space(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

void add_utf8(std::string& out, std::uint32_t code) {
    const auto tail = [&](unsigned shift) {
        out += static_cast<char>(0x80U | (code >> shift & 0x3fU));
    };
    if (code < 0x80) {
        out += static_cast<char>(code);
    } else if (code < 0x800) {
        out += static_cast<char>(0xc0U | code >> 6U);
        tail(0);
    } else if (code < 0x10000) {
        out += static_cast<char>(0xe0U | code >> 12U);
        tail(6);
        tail(0);
    } else {
        out += static_cast<char>(0xf0U | code >> 18U);
        tail(12);
        tail(6);
        tail(0);
    }
}

class XmlParser {
  public:
    explicit XmlParser(std::string_view text) : text_(text) {}

    std::optional<XmlElement> document() {
        if (text_.starts_with("\xef\xbb\xbf")) {
            at_ = 3;
        }
        XmlElement root;
        if (!skip_misc() || !element(root, 0) || !skip_misc() || at_ != text_.size()) {
            return std::nullopt;
        }
        return root;
    }

  private:
    [[nodiscard]] bool starts(std::string_view with) const {
        return text_.substr(at_).starts_with(with);
    }
    bool skip_past(std::string_view end) {
        const std::size_t found = text_.find(end, at_);
        at_ = found == std::string_view::npos ? text_.size() : found + end.size();
        return found != std::string_view::npos;
    }
    void skip_space() {
        while (at_ < text_.size() && is_xml_space(text_[at_])) {
            ++at_;
        }
    }
    /// Declaration, comments, instructions.
    bool skip_misc() {
        for (skip_space(); at_ < text_.size() && (starts("<?") || starts("<!--")); skip_space()) {
            if (!skip_past(starts("<?") ? "?>" : "-->")) {
                return false;
            }
        }
        return !starts("<!");
    }
    std::string name() {
        const std::size_t begin = at_;
        while (at_ < text_.size() && !is_xml_space(text_[at_]) &&
               std::string_view("=/>\"'<&").find(text_[at_]) == std::string_view::npos) {
            ++at_;
        }
        const std::string_view whole = text_.substr(begin, at_ - begin);
        const std::size_t colon = whole.find(':');
        return std::string(colon == std::string_view::npos ? whole : whole.substr(colon + 1));
    }
    bool entity(std::string& out) {
        const std::size_t end = text_.find(';', at_);
        if (end == std::string_view::npos || end - at_ > 10) {
            return false;
        }
        const std::string_view which = text_.substr(at_ + 1, end - at_ - 1);
        at_ = end + 1;
        for (const auto& [key, value] :
             {std::pair("amp", '&'), std::pair("lt", '<'), std::pair("gt", '>'),
              std::pair("quot", '"'), std::pair("apos", '\'')}) {
            if (which == key) {
                out += value;
                return true;
            }
        }
        if (!which.starts_with('#')) {
            return false;
        }
        const bool hexadecimal = which.starts_with("#x");
        const std::string_view digits = which.substr(hexadecimal ? 2 : 1);
        std::uint32_t code = 0;
        const auto [rest, error] = std::from_chars(digits.data(), digits.data() + digits.size(),
                                                   code, hexadecimal ? 16 : 10);
        const bool valid = error == std::errc() && rest == digits.data() + digits.size() &&
                           code > 0 && code < 0x110000 && (code < 0xd800 || code > 0xdfff);
        if (valid) {
            add_utf8(out, code);
        }
        return valid;
    }
    bool text_up_to(char end, std::string& out) {
        while (at_ < text_.size() && text_[at_] != end) {
            if (text_[at_] == '&') {
                if (!entity(out)) {
                    return false;
                }
            } else {
                out += text_[at_++];
            }
        }
        return at_ < text_.size();
    }
    bool attributes(XmlElement& element) {
        for (skip_space(); at_ < text_.size() && text_[at_] != '>' && text_[at_] != '/';
             skip_space()) {
            const std::string key = name();
            skip_space();
            if (key.empty() || !starts("=")) {
                return false;
            }
            ++at_;
            skip_space();
            const char quote = at_ < text_.size() ? text_[at_] : '\0';
            if (quote != '"' && quote != '\'') {
                return false;
            }
            ++at_;
            if (!text_up_to(quote, element.attributes[key])) {
                return false;
            }
            ++at_;
        }
        return at_ < text_.size();
    }
    bool element(XmlElement& result, int depth) {
        if (!starts("<") || depth > deepest_element || ++elements_ > most_elements) {
            return false;
        }
        ++at_;
        result.name = name();
        if (result.name.empty() || !attributes(result)) {
            return false;
        }
        if (starts("/>")) {
            at_ += 2;
            return true;
        }
        if (!starts(">")) {
            return false;
        }
        ++at_;
        return content(result, depth);
    }
    bool content(XmlElement& result, int depth) {
        while (text_up_to('<', result.text)) {
            if (starts("</")) {
                at_ += 2;
                const bool same = name() == result.name;
                skip_space();
                const bool closed = starts(">");
                ++at_;
                return same && closed;
            }
            if (starts("<!--") || starts("<?")) {
                if (!skip_past(starts("<?") ? "?>" : "-->")) {
                    return false;
                }
            } else if (starts("<![CDATA[")) {
                const std::size_t begin = at_ + 9;
                if (!skip_past("]]>")) {
                    return false;
                }
                result.text += text_.substr(begin, at_ - 3 - begin);
            } else if (!element(result.children.emplace_back(), depth + 1)) {
                return false;
            }
        }
        return false;
    }

    std::string_view text_;
    std::size_t at_ = 0;
    int elements_ = 0;
};

}  // namespace

const XmlElement* XmlElement::child(std::string_view wanted) const {
    for (const XmlElement& one : children) {
        if (one.name == wanted) {
            return &one;
        }
    }
    return nullptr;
}

std::string XmlElement::text_of(std::string_view wanted) const {
    const XmlElement* const found = child(wanted);
    return found == nullptr ? "" : found->text;
}

std::optional<XmlElement> read_xml(std::string_view text) {
    return XmlParser(text).document();
}

}  // namespace raybundle
