// SPDX-License-Identifier: Apache-2.0
#include "telemetry/otlp_message.h"

#include "otlp_trace.pb.h"

namespace raybundle {
namespace {

namespace wire = otlp::v1;

constexpr std::uint32_t kept_flag = 1;

std::string bytes_of(std::span<const std::uint8_t> id) {
    return {id.begin(), id.end()};
}

void set_value(wire::AnyValue& to, const AttributeValue& from) {
    if (const auto* const number = std::get_if<std::int64_t>(&from)) {
        to.set_int_value(*number);
    } else if (const auto* const real = std::get_if<double>(&from)) {
        to.set_double_value(*real);
    } else if (const auto* const truth = std::get_if<bool>(&from)) {
        to.set_bool_value(*truth);
    } else {
        to.set_string_value(std::get<std::string>(from));
    }
}

template <typename Owner>
void add_attribute(Owner& owner, const Attribute& attribute) {
    wire::KeyValue& to = *owner.add_attributes();
    to.set_key(attribute.first);
    set_value(*to.mutable_value(), attribute.second);
}

void fill(wire::Span& to, const Span& from) {
    to.set_trace_id(bytes_of(from.trace));
    to.set_span_id(bytes_of(from.id));
    if (from.parent) {
        to.set_parent_span_id(bytes_of(*from.parent));
    }
    to.set_name(from.name);
    to.set_kind(from.serves ? wire::Span::SPAN_KIND_SERVER : wire::Span::SPAN_KIND_INTERNAL);
    to.set_start_time_unix_nano(from.begun_ns);
    to.set_end_time_unix_nano(from.ended_ns);
    for (const Attribute& attribute : from.attributes) {
        add_attribute(to, attribute);
    }
    if (from.error) {
        to.mutable_status()->set_message(*from.error);
        to.mutable_status()->set_code(wire::Status::STATUS_CODE_ERROR);
    }
    to.set_flags(kept_flag);
}

}  // namespace

std::string otlp_message(const SpanSource& source, std::span<const Span> spans) {
    wire::ExportTraceServiceRequest request;
    wire::ResourceSpans& resource = *request.add_resource_spans();
    add_attribute(*resource.mutable_resource(), {"service.name", source.service});
    for (const Attribute& attribute : source.attributes) {
        add_attribute(*resource.mutable_resource(), attribute);
    }
    wire::ScopeSpans& scope = *resource.add_scope_spans();
    scope.mutable_scope()->set_name("raybundle");
    scope.mutable_scope()->set_version(RAYBUNDLE_VERSION);
    for (const Span& span : spans) {
        fill(*scope.add_spans(), span);
    }
    return request.SerializeAsString();
}

}  // namespace raybundle
