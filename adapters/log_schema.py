"""The protobuf messages of the log, declared at run time: no compiler, no generated code.

``poinsot.State`` is Poinsot's own. The ``foxglove`` messages carry the public schemas' names and field
numbers (https://docs.foxglove.dev/docs/sdk/schemas), only the fields that are filled here, so that any
viewer that knows those schemas draws a log. They live in a pool of their own: a program that also uses
Foxglove's package meets no second declaration.
"""

from typing import Any

from google.protobuf import descriptor_pb2, descriptor_pool, message_factory, timestamp_pb2

#: Field number, name and type of each message; ``[]`` is a list.
_STATE = {
    "State": (
        (1, "t", "double"),
        (2, "position", "double[]"),
        (3, "quaternion", "double[]"),
        (4, "velocity", "double[]"),
        (5, "omega", "double[]"),
        (6, "joint_position", "double[]"),
        (7, "joint_velocity", "double[]"),
        (8, "reaction", "double[]"),
    )
}
_GEOMETRY = {
    "Vector3": ((1, "x", "double"), (2, "y", "double"), (3, "z", "double")),
    "Quaternion": ((1, "x", "double"), (2, "y", "double"), (3, "z", "double"), (4, "w", "double")),
}
_FRAME = {
    "FrameTransform": (
        (1, "timestamp", "google.protobuf.Timestamp"),
        (2, "parent_frame_id", "string"),
        (3, "child_frame_id", "string"),
        (4, "translation", "foxglove.Vector3"),
        (5, "rotation", "foxglove.Quaternion"),
    ),
}
_SCENE = {
    "Pose": ((1, "position", "foxglove.Vector3"), (2, "orientation", "foxglove.Quaternion")),
    "Color": ((1, "r", "double"), (2, "g", "double"), (3, "b", "double"), (4, "a", "double")),
    "KeyValuePair": ((1, "key", "string"), (2, "value", "string")),
    "Point3": ((1, "x", "double"), (2, "y", "double"), (3, "z", "double")),
    "CubePrimitive": (
        (1, "pose", "foxglove.Pose"),
        (2, "size", "foxglove.Vector3"),
        (3, "color", "foxglove.Color"),
    ),
    "SpherePrimitive": (
        (1, "pose", "foxglove.Pose"),
        (2, "size", "foxglove.Vector3"),
        (3, "color", "foxglove.Color"),
    ),
    "CylinderPrimitive": (
        (1, "pose", "foxglove.Pose"),
        (2, "size", "foxglove.Vector3"),
        (3, "bottom_scale", "double"),
        (4, "top_scale", "double"),
        (5, "color", "foxglove.Color"),
    ),
    # Their type, field 1, is left at its 0: a strip.
    "LinePrimitive": (
        (2, "pose", "foxglove.Pose"),
        (3, "thickness", "double"),
        (4, "scale_invariant", "bool"),
        (5, "points", "foxglove.Point3[]"),
        (6, "color", "foxglove.Color"),
    ),
    "TriangleListPrimitive": (
        (1, "pose", "foxglove.Pose"),
        (2, "points", "foxglove.Point3[]"),
        (3, "color", "foxglove.Color"),
        (5, "indices", "fixed32[]"),
    ),
    "SceneEntity": (
        (1, "timestamp", "google.protobuf.Timestamp"),
        (2, "frame_id", "string"),
        (3, "id", "string"),
        (5, "frame_locked", "bool"),
        (6, "metadata", "foxglove.KeyValuePair[]"),
        (8, "cubes", "foxglove.CubePrimitive[]"),
        (9, "spheres", "foxglove.SpherePrimitive[]"),
        (10, "cylinders", "foxglove.CylinderPrimitive[]"),
        (11, "lines", "foxglove.LinePrimitive[]"),
        (12, "triangles", "foxglove.TriangleListPrimitive[]"),
    ),
    "SceneUpdate": ((2, "entities", "foxglove.SceneEntity[]"),),
}

_Field = descriptor_pb2.FieldDescriptorProto
_SCALARS = {
    "double": _Field.TYPE_DOUBLE,
    "string": _Field.TYPE_STRING,
    "bool": _Field.TYPE_BOOL,
    "fixed32": _Field.TYPE_FIXED32,
}


def _file(name: str, package: str, syntax: str, messages: dict[str, Any], imports: tuple[str, ...]) -> Any:
    file = descriptor_pb2.FileDescriptorProto(name=name, package=package, syntax=syntax, dependency=imports)
    for message, fields in messages.items():
        declared = file.message_type.add(name=message)
        for number, field, kind in fields:
            _declare(declared.field.add(name=field, number=number), kind, packed=syntax == "proto2")
    return file


def _declare(field: Any, kind: str, packed: bool) -> None:
    element = kind.removesuffix("[]")
    field.label = _Field.LABEL_OPTIONAL if element == kind else _Field.LABEL_REPEATED
    if element in _SCALARS:
        field.type = _SCALARS[element]
    else:
        field.type, field.type_name = _Field.TYPE_MESSAGE, f".{element}"
    if packed and element != kind:
        field.options.packed = True


_pool = descriptor_pool.DescriptorPool()
_pool.AddSerializedFile(timestamp_pb2.DESCRIPTOR.serialized_pb)
# proto2, because there a scalar that was set is written even when it is zero.
_pool.Add(_file("poinsot/state.proto", "poinsot", "proto2", _STATE, ()))
_STAMP, _PLACES = "google/protobuf/timestamp.proto", "foxglove/geometry.proto"
_pool.Add(_file(_PLACES, "foxglove", "proto3", _GEOMETRY, ()))
# Apart from each other, because each channel of a log holds its own file twice.
_pool.Add(_file("foxglove/frame.proto", "foxglove", "proto3", _FRAME, (_STAMP, _PLACES)))
_pool.Add(_file("foxglove/scene.proto", "foxglove", "proto3", _SCENE, (_STAMP, _PLACES)))


def _message(name: str) -> Any:
    return message_factory.GetMessageClass(_pool.FindMessageTypeByName(name))


State = _message("poinsot.State")
FrameTransform = _message("foxglove.FrameTransform")
SceneUpdate = _message("foxglove.SceneUpdate")


def descriptor_set(message: Any) -> bytes:
    """The files that declare ``message``, those it needs first, as a serialised ``FileDescriptorSet``."""
    result = descriptor_pb2.FileDescriptorSet()
    own = message.DESCRIPTOR.file
    for file in (*own.dependencies, own):
        file.CopyToProto(result.file.add())
    return bytes(result.SerializeToString(deterministic=True))
