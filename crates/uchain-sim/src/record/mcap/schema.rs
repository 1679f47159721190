//! The schema of our own messages, read out of their `.proto` file: what is committed is what is recorded.

use prost::Message as _;
use prost_types::{
    DescriptorProto, FieldDescriptorProto, FileDescriptorProto, FileDescriptorSet,
    field_descriptor_proto::{Label, Type},
};

/// The package, as it stands before every message's name.
pub(super) const PACKAGE: &str = "uchain";

/// The file of a mission's frames and metrics.
pub(super) const FILE: &str = "uchain.proto";

/// A serialized `FileDescriptorSet` of all messages of a file in the language of protobuf, of which it knows as much as
/// our messages need: messages of numbers and lists of them, a field a line.
pub(super) fn descriptors(file: &str, proto: &str) -> Vec<u8> {
    let mut messages: Vec<DescriptorProto> = Vec::new();
    for line in proto.lines() {
        let line = line.split("//").next().unwrap_or_default();
        let words: Vec<&str> = line.split([' ', ';', '=']).filter(|word| !word.is_empty()).collect();
        match (words.as_slice(), messages.last_mut()) {
            (["message", name, "{"], _) => {
                messages.push(DescriptorProto { name: Some((*name).to_owned()), ..Default::default() });
            }
            (["repeated", kind, name, number], Some(message)) => {
                message.field.extend(field(Label::Repeated, kind, name, number));
            }
            ([kind, name, number], Some(message)) => {
                message.field.extend(field(Label::Optional, kind, name, number));
            }
            _ => {}
        }
    }
    let file = FileDescriptorProto {
        name: Some(file.to_owned()),
        package: Some(PACKAGE.to_owned()),
        syntax: Some("proto3".to_owned()),
        message_type: messages,
        ..Default::default()
    };
    FileDescriptorSet { file: vec![file] }.encode_to_vec()
}

fn field(label: Label, kind: &str, name: &str, number: &str) -> Option<FieldDescriptorProto> {
    let kind = match kind {
        "bool" => Type::Bool,
        "float" => Type::Float,
        "double" => Type::Double,
        "uint32" => Type::Uint32,
        "uint64" => Type::Uint64,
        _ => return None,
    };
    Some(FieldDescriptorProto {
        name: Some(name.to_owned()),
        number: Some(number.parse().ok()?),
        label: Some(label.into()),
        r#type: Some(kind.into()),
        ..Default::default()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const PROTO: &str = include_str!("../../mission/uchain.proto");

    #[test]
    fn every_field_of_the_proto_file_is_in_the_schema() {
        let set = FileDescriptorSet::decode(descriptors(FILE, PROTO).as_slice()).unwrap();
        let counts: Vec<(&str, usize)> =
            set.file[0].message_type.iter().map(|message| (message.name(), message.field.len())).collect();
        assert_eq!(counts, [("Frame", 25), ("Metrics", 7), ("ExploreFrame", 29), ("ExploreMetrics", 8)]);
        let written = PROTO.lines().filter(|line| line.starts_with("  ") && line.contains(" = ")).count();
        assert_eq!(written, 25 + 7 + 29 + 8);
    }
}
