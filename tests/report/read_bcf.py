#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Reads a BCF 3.0 archive by the public schema's names and order, and prints its topics as JSON.

usage: read_bcf.py FILE; exit status 1 and a reason where something is not as version.xsd, extensions.xsd, markup.xsd and
visinfo.xsd of buildingSMART have it."""
import json
import re
import sys
import zipfile
from datetime import datetime
from xml.etree import ElementTree

GUID = re.compile(r"^[a-f0-9]{8}-[a-f0-9]{4}-[a-f0-9]{4}-[a-f0-9]{4}-[a-f0-9]{12}$")
# Children in the order of the schema's sequence; ! marks those that must be there.
TOPIC = ["ReferenceLinks", "!Title", "Priority", "Index", "Labels", "!CreationDate", "!CreationAuthor", "ModifiedDate",
         "ModifiedAuthor", "DueDate", "AssignedTo", "Stage", "Description", "BimSnippet", "DocumentReferences",
         "RelatedTopics", "Comments", "Viewpoints"]
COMMENT = ["!Date", "!Author", "Comment", "Viewpoint", "ModifiedDate", "ModifiedAuthor"]
VIEWPOINT = ["Viewpoint", "Snapshot", "Index"]
CAMERA = ["!CameraViewPoint", "!CameraDirection", "!CameraUpVector", "!FieldOfView", "!AspectRatio"]
VISUALIZATION = ["Components", "OrthogonalCamera", "PerspectiveCamera", "Lines", "ClippingPlanes", "Bitmaps"]


def fail(reason):
    print(reason, file=sys.stderr)
    sys.exit(1)


def check_children(element, schema):
    order = [name.lstrip("!") for name in schema]
    found = [child.tag for child in element]
    for name in found:
        if name not in order:
            fail(f"{element.tag} has {name}, which the schema does not know")
    if [order.index(name) for name in found] != sorted(order.index(name) for name in found):
        fail(f"{element.tag}: {found} are not in the order of the schema")
    for name in schema:
        if name.startswith("!") and name[1:] not in found:
            fail(f"{element.tag} lacks {name[1:]}")


def guid_of(element):
    guid = element.get("Guid", "")
    if not GUID.match(guid):
        fail(f"{element.tag}: {guid!r} is no GUID")
    return guid


def vector(element):
    check_children(element, ["!X", "!Y", "!Z"])
    return [float(element.findtext(name)) for name in "XYZ"]


def read_viewpoint(archive, name, guid):
    root = ElementTree.fromstring(archive.read(name))
    if root.tag != "VisualizationInfo" or guid_of(root) != guid:
        fail(f"{name}: not the VisualizationInfo of {guid}")
    check_children(root, VISUALIZATION)
    camera = root.find("PerspectiveCamera")
    check_children(camera, CAMERA)
    field = float(camera.findtext("FieldOfView"))
    if not 0 < field < 180:
        fail(f"{name}: a field of view of {field}")
    return {"eye": vector(camera.find("CameraViewPoint")), "direction": vector(camera.find("CameraDirection")),
            "up": vector(camera.find("CameraUpVector")), "field": field}


def read_topic(archive, folder, extensions):
    root = ElementTree.fromstring(archive.read(f"{folder}/markup.bcf"))
    if root.tag != "Markup":
        fail(f"{folder}: the root is {root.tag}")
    check_children(root, ["Header", "!Topic"])
    topic = root.find("Topic")
    check_children(topic, TOPIC)
    if guid_of(topic) != folder:
        fail(f"{folder}: its topic is {topic.get('Guid')}")
    for attribute, known in (("TopicType", extensions["types"]), ("TopicStatus", extensions["statuses"])):
        if topic.get(attribute) not in known:
            fail(f"{folder}: {attribute} {topic.get(attribute)!r} is not in extensions.xml")
    for label in topic.iterfind("Labels/Label"):
        if label.text not in extensions["labels"]:
            fail(f"{folder}: label {label.text!r} is not in extensions.xml")
    comments = []
    for comment in topic.iterfind("Comments/Comment"):
        guid_of(comment)
        check_children(comment, COMMENT)
        datetime.fromisoformat(comment.findtext("Date").replace("Z", "+00:00"))
        comments.append({"author": comment.findtext("Author"), "text": comment.findtext("Comment")})
    viewpoints = []
    for viewpoint in topic.iterfind("Viewpoints/ViewPoint"):
        check_children(viewpoint, VIEWPOINT)
        viewpoints.append(read_viewpoint(archive, f"{folder}/{viewpoint.findtext('Viewpoint')}", guid_of(viewpoint)))
    datetime.fromisoformat(topic.findtext("CreationDate").replace("Z", "+00:00"))
    return {"guid": folder, "title": topic.findtext("Title"), "status": topic.get("TopicStatus"),
            "assignedTo": topic.findtext("AssignedTo"), "description": topic.findtext("Description"),
            "author": topic.findtext("CreationAuthor"), "comments": comments, "viewpoints": viewpoints}


def main():
    with zipfile.ZipFile(sys.argv[1]) as archive:
        if archive.testzip():
            fail("a checksum is wrong")
        version = ElementTree.fromstring(archive.read("bcf.version"))
        if version.tag != "Version" or version.get("VersionId") != "3.0":
            fail("bcf.version is not that of 3.0")
        root = ElementTree.fromstring(archive.read("extensions.xml"))
        check_children(root, ["TopicTypes", "TopicStatuses", "Priorities", "TopicLabels", "Users", "SnippetTypes", "Stages"])
        extensions = {key: {element.text for element in root.iterfind(path)} for key, path in
                      (("types", "TopicTypes/TopicType"), ("statuses", "TopicStatuses/TopicStatus"),
                       ("labels", "TopicLabels/TopicLabel"))}
        folders = sorted({name.split("/")[0] for name in archive.namelist() if name.endswith("/markup.bcf")})
        print(json.dumps([read_topic(archive, folder, extensions) for folder in folders]))


if __name__ == "__main__":
    main()
