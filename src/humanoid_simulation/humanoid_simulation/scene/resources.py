# SPDX-License-Identifier: Apache-2.0
"""Load worlds and objects by URI or from text."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TypeVar
from urllib.parse import unquote, urlsplit

from humanoid_common.errors import UserError
from humanoid_common.tables import load_table, Table, table_of
from humanoid_description.checks.joints import STRUCTURE
from humanoid_description.errors import DescriptionError
from humanoid_description.kinematics import poses
from humanoid_description.loading import load_robot
from humanoid_description.robot import Array, Shape
from humanoid_description.rotations import to_rpy
from humanoid_simulation.errors import ResourceError
from humanoid_simulation.files import installed_scenes, SCENE_SUFFIXES
from humanoid_simulation.scene.home_reading import colour_in
from humanoid_simulation.scene.loading import load_scene, scene_of, thing_in
from humanoid_simulation.scene.objects import CLASSES, ObjectInstance, thing_of
from humanoid_simulation.scene.parts import COLOURS, MESH, Part
from humanoid_simulation.scene.scene import COMPOSED, Scene, Thing
import numpy as np

THING_FORMATS = ('urdf', 'yaml')
GIVEN_TEXT = 'resource_string'
"""The name of text that is not from a file, in error messages."""
_URDF_SUFFIXES = ('.urdf', '.xml')

T = TypeVar('T')


@dataclass(frozen=True)
class LoadableWorld:
    """A scene that can be loaded."""

    name: str
    uri: str
    description: str


def installed_worlds() -> list[LoadableWorld]:
    """Return the installed worlds."""
    return [_world(path, name) for name, path in installed_scenes().items()]


def world_at(uri: str) -> LoadableWorld:
    """
    Describe a world that can be loaded, without loading it.

    Parameters
    ----------
    uri
        The name of an installed world, or the path, `file://` or `package://` URI of a scene file.

    Raises
    ------
    ResourceError
        There is no such world.

    """
    return _world(_scene_file(uri), uri)


def worlds_in(source: str) -> list[LoadableWorld]:
    """
    List the worlds of a folder.

    Parameters
    ----------
    source
        The path, `file://` or `package://` URI of the folder.

    Raises
    ------
    ResourceError
        The folder, or a scene file in it, cannot be read.

    """
    folder = _path_of(source)
    try:
        paths = sorted(path for path in folder.iterdir() if path.suffix in SCENE_SUFFIXES)
    except OSError as error:
        raise ResourceError(
            'NO_RESOURCE',
            f"The source '{source}' cannot be read: {error.strerror}. Give a folder.",
        ) from error
    return [_world(path, str(path)) for path in paths]


def world_of(uri: str, text: str) -> tuple[LoadableWorld, Scene]:
    """
    Load a world.

    Parameters
    ----------
    uri
        The name of an installed one, or the path or URI of a scene file.
    text
        The content of a scene file, which is used if the URI is empty.

    Raises
    ------
    ResourceError
        There is no such world, or it has a mistake.

    """
    if not uri:
        return LoadableWorld('world', '', ''), _parsed(lambda: scene_of(_table(text), 'world'))
    path = _scene_file(uri)
    scene = _parsed(lambda: load_scene(str(path)))
    return _world(path, uri), scene


def spawnables() -> list[tuple[str, str, Thing]]:
    """Return the URI, a description and an example object of each class of objects."""
    return [
        (kind, f"a {kind}; 'red {kind}' and other colours as well", thing_from(kind, '', kind))
        for kind in CLASSES
    ]


def thing_from(uri: str, text: str, name: str) -> Thing:
    """
    Build an object at the origin.

    Parameters
    ----------
    uri
        A class, optionally preceded by a colour ('red mug'), or the path or URI of a URDF, or of
        a YAML file with the entry of one object, as in a scene file.
    text
        The content of such a file, which is used if the URI is empty.
    name
        The name of the new object.

    Raises
    ------
    ResourceError
        There is no such class or file, or it has a mistake.

    """
    colour, _, kind = uri.strip().rpartition(' ')
    if kind in CLASSES and (not colour or colour in COLOURS):
        return _of_class(name, kind, colour)
    if uri:
        path = _file(uri, (*_URDF_SUFFIXES, *SCENE_SUFFIXES), _known_things())
        if path.suffix in SCENE_SUFFIXES:
            return _parsed(lambda: _described(load_table(path), name))
        return _rigid(_read(path), str(path), name)
    if text.lstrip().startswith('<'):
        return _rigid(text, GIVEN_TEXT, name)
    return _parsed(lambda: _described(_table(text), name))


def _known_things() -> str:
    """Describe the classes of objects, for an error message."""
    return f"an object class ({', '.join(CLASSES)}), optionally with a colour as in 'red mug'"


def _of_class(name: str, kind: str, colour: str = '') -> Thing:
    """Build an object of a class."""
    colour = colour or CLASSES[kind].colour
    graspable = ObjectInstance(name, kind, colour, COLOURS[colour], (0.0, 0.0, 0.0))
    return replace(thing_of(graspable), position_m=(0.0, 0.0, 0.0))


def _described(table: Table, name: str) -> Thing:
    """Build the object that a table describes, by its class or by its shape."""
    if not table.has('class') or table.has('shape'):
        return thing_in(table, name, (0.0, 0.0, 0.0))
    table.allow('name', 'class', 'colour', 'size')
    kind = table.choice('class', tuple(CLASSES))
    default = CLASSES[kind].colour
    colour, rgb = colour_in(table, 'colour', COLOURS[default])
    size = table.vector('size', 3) if table.has('size') else None
    graspable = ObjectInstance(name, kind, colour, rgb, (0.0, 0.0, 0.0), size_m=size)
    return replace(table.place.checked(lambda: thing_of(graspable)), position_m=(0.0, 0.0, 0.0))


def _rigid(urdf: str, source: str, name: str) -> Thing:
    """Build one rigid object from a URDF, which must not have moving joints."""
    try:
        robot = load_robot(urdf, source)
    except DescriptionError as error:
        raise ResourceError('RESOURCE_PARSE_ERROR', str(error)) from error
    defects = [defect for check in STRUCTURE for defect in check(robot).defects]
    if defects:
        raise ResourceError('RESOURCE_PARSE_ERROR', f'{source}: {defects[0]}')
    moving = [joint.name for joint in robot.joints if joint.kind != 'fixed']
    if moving:
        raise ResourceError(
            'UNSUPPORTED_FORMAT',
            f"{source} has the movable joint '{moving[0]}'. Only rigid objects can be spawned; "
            "robots are set by the parameter 'robots' of the simulator.",
        )
    link_poses = poses(robot)
    solid = [(link, shape) for link in robot.links for shape in link.collisions]
    seen = [(link, shape) for link in robot.links for shape in link.visuals]
    parts = [
        _part(shape, link_poses[link.name] @ shape.pose, source, collides, is_shown)
        for shapes, collides, is_shown in ((solid, True, not seen), (seen, not solid, True))
        for link, shape in shapes
    ]
    if not parts:
        raise ResourceError('RESOURCE_PARSE_ERROR', f'{source} has no geometry.')
    mass_kg = sum(link.body.mass_kg for link in robot.links if link.body is not None)
    reach_m = [np.abs(part.position_m) + part.extent_m for part in parts]
    size_m = np.max(reach_m, axis=0) * 2.0
    return _parsed(
        lambda: Thing(
            name, COMPOSED, tuple(size_m.tolist()), mass_kg=mass_kg, details=tuple(parts)
        )
    )


def _part(shape: Shape, pose: Array, source: str, collides: bool, is_shown: bool) -> Part:
    """Convert a URDF shape to a part, in the frame of the object."""
    if shape.kind == MESH:
        raise ResourceError(
            'UNSUPPORTED_ASSETS',
            f'{source} has a mesh, which is not supported. Use boxes, cylinders and spheres.',
        )
    x_m, y_m, z_m = pose[:3, 3].tolist()
    return _parsed(
        lambda: Part(
            shape.kind,
            shape.size_m,
            (x_m, y_m, z_m),
            to_rpy(pose[:3, :3]),
            collides=collides,
            is_shown=is_shown,
        )
    )


def _scene_file(uri: str) -> Path:
    """Return the scene file of a world, by the name of an installed one or by its URI."""
    installed = installed_scenes()
    return installed.get(uri) or _file(uri, SCENE_SUFFIXES, f'a world: {", ".join(installed)}')


def _world(path: Path, uri: str) -> LoadableWorld:
    """Describe the world of a scene file by the comment at its top."""
    words: list[str] = []
    try:
        with open(path, encoding='utf-8') as stream:
            for line in stream:
                comment = line.strip('# \n')
                if not line.startswith('#') or not comment:
                    break
                words.append(comment)
    except (OSError, UnicodeDecodeError) as error:
        reason = error.strerror if isinstance(error, OSError) else str(error)
        raise ResourceError(
            'NO_RESOURCE', f"'{path}' cannot be read: {reason}. Give a scene file."
        ) from error
    return LoadableWorld(path.stem, uri, ' '.join(words))


def _table(text: str) -> Table:
    """Parse text that is not from a file."""
    if not text.strip():
        raise ResourceError('NO_RESOURCE', 'Give a uri or a resource_string; both are empty.')
    return table_of(text, GIVEN_TEXT)


def _parsed(make: Callable[[], T]) -> T:
    """Call a parser, and convert its errors to `RESOURCE_PARSE_ERROR`."""
    try:
        return make()
    except ResourceError:
        raise
    except UserError as error:
        raise ResourceError('RESOURCE_PARSE_ERROR', str(error)) from error


def _read(path: Path) -> str:
    """Return the text of a file."""
    try:
        return path.read_text(encoding='utf-8')
    except (OSError, UnicodeDecodeError) as error:
        raise ResourceError('RESOURCE_PARSE_ERROR', f'{path} cannot be read: {error}.') from error


def _file(uri: str, suffixes: tuple[str, ...], known: str) -> Path:
    """Resolve a URI to a path, which must exist and have a supported suffix."""
    path = _path_of(uri)
    if not path.suffix:
        raise ResourceError('NO_RESOURCE', f"'{uri}' is neither a file nor {known}.")
    if path.suffix not in suffixes:
        raise ResourceError(
            'UNSUPPORTED_FORMAT',
            f"'{uri}' is not a supported file. Give a file that ends with {', '.join(suffixes)}.",
        )
    if not path.is_file():
        raise ResourceError('NO_RESOURCE', f'File {path} not found. Correct the uri.')
    return path


def _path_of(uri: str) -> Path:
    """Resolve a path, or a `file://` or `package://` URI, to a path."""
    parts = urlsplit(uri)
    if parts.scheme == 'package':
        from ament_index_python.packages import get_package_share_directory, PackageNotFoundError

        try:
            share = get_package_share_directory(parts.netloc)
        except (PackageNotFoundError, ValueError) as error:
            raise ResourceError(
                'NO_RESOURCE', f"Package '{parts.netloc}' of '{uri}' not found."
            ) from error
        return Path(share) / unquote(parts.path).lstrip('/')
    if parts.scheme == 'file':
        return Path(unquote(parts.path))
    if parts.scheme:
        raise ResourceError(
            'UNSUPPORTED_FORMAT', f"'{uri}' has an unsupported scheme. Give a file or package URI."
        )
    return Path(uri)
