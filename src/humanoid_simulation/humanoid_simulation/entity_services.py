# SPDX-License-Identifier: Apache-2.0
"""Services of `simulation_interfaces` for entities: robots, and objects of the scene."""

from __future__ import annotations

from dataclasses import replace
import re
from typing import Any

from geometry_msgs.msg import Vector3
from humanoid_control.hosting.topics.filling import fill_quaternion, fill_stamp, fill_vector
from humanoid_description.rotations import from_quaternion, quaternion_from_rpy, to_rpy
from humanoid_simulation.backend.mujoco_backend import MujocoBackend
from humanoid_simulation.backend.state import check_bounds, EntityState
from humanoid_simulation.entity_catalogue import (
    Category,
    Description,
    Region,
    Search,
    Tags,
)
from humanoid_simulation.errors import SimulationError
from humanoid_simulation.quaternions import product, rotated
from humanoid_simulation.scene.resources import spawnables, thing_from
from humanoid_simulation.scene.scene import FLOOR, Scene, WORLD
from humanoid_simulation.service_messages import (
    answering,
    entity_state,
    refusing,
    refusing_resource,
    RequestError,
    vector,
)
from humanoid_simulation.simulated_world import SimulatedWorld
import numpy as np
from rclpy.node import Node
from simulation_interfaces.msg import (
    Bounds,
    EntityFilters,
    EntityInfo,
    NamedPose,
    Resource,
    Result,
    Spawnable,
    TagsFilter,
)
from simulation_interfaces.msg import EntityState as EntityStateMessage
from simulation_interfaces.srv import (
    DeleteEntity,
    GetEntities,
    GetEntitiesStates,
    GetEntityBounds,
    GetEntityInfo,
    GetEntityState,
    GetNamedPoseBounds,
    GetNamedPoses,
    GetSpawnables,
    SetEntityInfo,
    SetEntityState,
    SpawnEntity,
)

MOST_THINGS = 1000
"""Maximum number in a scene: each one costs time in every step and in every scene change."""
_NAME = re.compile(r'[A-Za-z0-9_][A-Za-z0-9_. -]*')
_NAMESPACE = re.compile(r'/?([A-Za-z_][A-Za-z0-9_]*(/[A-Za-z_][A-Za-z0-9_]*)*)?')


class EntityServices:
    """
    Services of `simulation_interfaces` that find, describe, move, spawn and delete entities.

    Parameters
    ----------
    node
        The node that provides them, below its own name.
    world
        The world that they act on.

    """

    def __init__(self, node: Node, world: SimulatedWorld) -> None:
        self._world, self._catalogue = world, world.catalogue
        for kind, name, do in (
            (GetEntities, 'get_entities', self._find),
            (GetEntitiesStates, 'get_entities_states', self._tell_states),
            (GetEntityState, 'get_entity_state', self._tell_state),
            (GetEntityInfo, 'get_entity_info', self._tell_info),
            (GetEntityBounds, 'get_entity_bounds', self._tell_bounds),
            (GetNamedPoses, 'get_named_poses', self._tell_places),
            (GetNamedPoseBounds, 'get_named_pose_bounds', self._tell_place_bounds),
            (GetSpawnables, 'get_spawnables', self._tell_spawnables),
            (SetEntityState, 'set_entity_state', self._put),
            (SetEntityInfo, 'set_entity_info', self._set_info),
            (SpawnEntity, 'spawn_entity', self._spawn),
            (DeleteEntity, 'delete_entity', self._delete),
        ):
            node.create_service(kind, f'~/{name}', answering(do))

    @property
    def _backend(self) -> MujocoBackend:
        return self._world.backend

    def _find(self, request: GetEntities.Request, response: GetEntities.Response) -> None:
        """List the entities that match a filter."""
        response.entities = self._catalogue.found(_search(request.filters))

    def _tell_states(
        self, request: GetEntitiesStates.Request, response: GetEntitiesStates.Response
    ) -> None:
        """Report the states of the entities that match a filter."""
        response.entities = self._catalogue.found(_search(request.filters))
        response.states = [self._state(entity) for entity in response.entities]

    def _tell_state(self, request: GetEntityState.Request, response: Any) -> None:
        """Report the state of an entity."""
        response.state = self._state(self._entity(request.entity))

    def _tell_info(self, request: GetEntityInfo.Request, response: Any) -> None:
        """Report the description of an entity."""
        description = self._catalogue.describe(self._entity(request.entity))
        info = EntityInfo(description=description.text, tags=list(description.tags))
        info.category.category = int(description.category)
        response.info = info

    def _set_info(self, request: SetEntityInfo.Request, _: Any) -> None:
        """Override the description of an entity."""
        entity, info = self._entity(request.entity), request.info
        if info.category.category not in list(Category):
            raise SimulationError(
                f'There is no category {info.category.category}. Give one of EntityCategory.'
            )
        category = Category(info.category.category)
        self._catalogue.change(entity, Description(category, info.description, tuple(info.tags)))

    def _tell_bounds(self, request: GetEntityBounds.Request, response: Any) -> None:
        """Report the bounding box of an entity, in its own axes."""
        response.bounds = _box(*self._backend.entity_box(self._entity(request.entity)))

    def _tell_places(self, request: GetNamedPoses.Request, response: Any) -> None:
        """List the named places of the scene, which are poses to stand in."""
        for place in self._backend.scene.places:
            surface = place.surface.name if place.surface else ''
            tags = [tag for tag in (place.room, surface) if tag]
            if not _tags(request.tags).match(tags):
                continue
            words = f'where {surface} is within reach' if surface else 'where the robot can stand'
            pose = NamedPose(name=place.name, description=words, tags=tags)
            pose.pose.position.x, pose.pose.position.y = place.x_m, place.y_m
            fill_quaternion(pose.pose.orientation, quaternion_from_rpy(0.0, 0.0, place.yaw_rad))
            response.poses.append(pose)

    def _tell_place_bounds(self, request: GetNamedPoseBounds.Request, _: Any) -> None:
        """Reject the request: a place is a pose to stand in, without bounds."""
        with refusing(Result.RESULT_NOT_FOUND):
            self._backend.scene.place(request.name)
        raise RequestError(
            Result.RESULT_FEATURE_UNSUPPORTED,
            'Named poses have no bounds here: they are poses to stand at. get_entity_bounds '
            'returns the bounds of an object.',
        )

    def _tell_spawnables(self, _: Any, response: GetSpawnables.Response) -> None:
        """List the classes of objects that can be spawned; files are not searched for."""
        for uri, description, thing in spawnables():
            half_m = np.array(thing.box_m) / 2.0
            response.spawnables.append(
                Spawnable(
                    entity_resource=Resource(uri=uri),
                    description=description,
                    spawn_bounds=_box(-half_m, half_m),
                )
            )

    def _put(self, request: SetEntityState.Request, _: Any) -> None:
        """Set the state of an entity; a fixed one is rejected."""
        entity = self._entity(request.entity)
        self._world.refuse_after_failure()
        with refusing(SetEntityState.Response.INVALID_POSE):
            self._world.put(entity, self._in_world(request.state))

    def _spawn(self, request: SpawnEntity.Request, response: SpawnEntity.Response) -> None:
        """Spawn an object."""
        name = self._new_name(request)
        if not _NAMESPACE.fullmatch(request.entity_namespace):
            raise RequestError(
                SpawnEntity.Response.NAMESPACE_INVALID,
                f"'{request.entity_namespace}' is not a valid namespace. Objects have no topics: "
                'leave it empty.',
            )
        resource, scene = request.entity_resource, self._backend.scene
        if len(scene.things) >= MOST_THINGS:
            raise SimulationError(
                f'The scene already has {MOST_THINGS} objects, the maximum. Delete some first.'
            )
        initial = request.initial_pose
        with refusing(SpawnEntity.Response.INVALID_POSE):
            state = self._in_world(EntityStateMessage(header=initial.header, pose=initial.pose))
            check_bounds(state)
        with refusing_resource(SpawnEntity.Response):
            thing = thing_from(resource.uri, resource.resource_string, name)
        x_m, y_m, z_m = state.position_m.tolist()
        rpy_rad = to_rpy(from_quaternion(state.orientation))
        placed = replace(thing, name=name, position_m=(x_m, y_m, z_m), orientation_rpy_rad=rpy_rad)
        self._world.change_scene(replace(scene, things=(*scene.things, placed)))
        response.entity_name = name

    def _delete(self, request: DeleteEntity.Request, _: Any) -> None:
        """Delete an object from the scene."""
        entity, scene = self._entity(request.entity), self._backend.scene
        things = tuple(thing for thing in scene.things if thing.name != entity)
        if len(things) == len(scene.things):
            raise SimulationError(
                f"'{entity}' is a robot, which cannot be deleted. The parameter 'robots' of the "
                'simulator sets which robots there are.'
            )
        self._world.change_scene(_without(scene, entity, things))
        self._catalogue.forget([entity])

    def _entity(self, name: str) -> str:
        """Resolve the name of an entity, or raise RequestError."""
        with refusing(Result.RESULT_NOT_FOUND):
            return self._backend.entity(name)

    def _state(self, entity: str) -> EntityStateMessage:
        """Build the message of the state of an entity."""
        state, message = self._backend.entity_state(entity), EntityStateMessage()
        message.header.frame_id = WORLD
        fill_stamp(message.header.stamp, self._backend.time_s)
        fill_vector(message.pose.position, state.position_m)
        fill_quaternion(message.pose.orientation, state.orientation)
        fill_vector(message.twist.linear, state.linear_velocity_m_s)
        fill_vector(message.twist.angular, state.angular_velocity_rad_s)
        fill_vector(message.acceleration.linear, state.linear_acceleration_m_s2)
        fill_vector(message.acceleration.angular, state.angular_acceleration_rad_s2)
        return message

    def _in_world(self, message: EntityStateMessage) -> EntityState:
        """Transform a state to the world from its frame: the world, or the pose of an entity."""
        state, frame = entity_state(message), message.header.frame_id
        if frame in ('', WORLD):
            return state
        outer = self._backend.entity_state(frame)
        turn = outer.orientation
        return EntityState(
            outer.position_m + rotated(state.position_m, turn),
            product(turn, state.orientation),
            rotated(state.linear_velocity_m_s, turn),
            rotated(state.angular_velocity_rad_s, turn),
        )

    def _new_name(self, request: SpawnEntity.Request) -> str:
        """Determine the name of a new entity, or raise RequestError."""
        name, taken = request.name, {*self._backend.entities, FLOOR, WORLD}
        if not name and request.allow_renaming:
            words = re.findall(r'\w+', request.entity_resource.uri.rpartition('/')[2])
            name = '_'.join(words) or 'thing'
        if not _NAME.fullmatch(name):
            raise RequestError(
                SpawnEntity.Response.NAME_INVALID,
                f"An entity cannot be named '{name}'. Give a name of letters, digits and '_', or "
                'allow_renaming.',
            )
        if name in taken and not request.allow_renaming:
            raise RequestError(
                SpawnEntity.Response.NAME_NOT_UNIQUE,
                f"There is already an entity '{name}'. Give another name, or set allow_renaming.",
            )
        numbered = (f'{name}_{number}' for number in range(2, len(taken) + 3))
        return name if name not in taken else next(each for each in numbered if each not in taken)


def _without(scene: Scene, entity: str, things: tuple[Any, ...]) -> Scene:
    """Return a scene without an entity, its surfaces, and references of places to these."""
    gone = {
        surface.name
        for surface in scene.surfaces
        if surface.name == entity or surface.name.startswith(f'{entity}/')
    }
    places = tuple(
        replace(place, surface=None) if place.surface and place.surface.name in gone else place
        for place in scene.places
    )
    surfaces = tuple(surface for surface in scene.surfaces if surface.name not in gone)
    return replace(scene, things=things, places=places, surfaces=surfaces)


def _search(filters: EntityFilters) -> Search:
    """Convert a message to an entity filter."""
    return Search(
        filters.filter,
        tuple(category.category for category in filters.categories),
        _tags(filters.tags),
        _region(filters.bounds),
    )


def _region(bounds: Bounds) -> Region | None:
    """Convert bounds to a region; None is the whole world."""
    if bounds.type == Bounds.TYPE_EMPTY:
        return None
    points = [vector(point) for point in bounds.points]
    if not np.isfinite(points).all():
        raise SimulationError('The bounds have a value that is not finite.')
    if bounds.type == Bounds.TYPE_BOX and len(points) == 2 and (points[0] <= points[1]).all():
        return Region(points[0], points[1])
    if bounds.type == Bounds.TYPE_SPHERE and len(points) == 2 and points[1][0] >= 0.0:
        return Region(points[0], points[0], float(points[1][0]))
    if bounds.type == Bounds.TYPE_CONVEX_HULL:
        raise RequestError(
            Result.RESULT_FEATURE_UNSUPPORTED,
            'Searching for entities in a convex hull is not supported. Give a box or a sphere.',
        )
    raise SimulationError(
        'The bounds are not valid. Give a box by its lower and upper corners, or a sphere by its '
        'centre and (radius, 0, 0).'
    )


def _box(low_m: Any, high_m: Any) -> Bounds:
    """Build the message of a box."""
    bounds = Bounds(type=Bounds.TYPE_BOX)
    for corner_m in (low_m, high_m):
        point = Vector3()
        fill_vector(point, corner_m)
        bounds.points.append(point)
    return bounds


def _tags(wanted: TagsFilter) -> Tags:
    """Convert a message to a tag filter."""
    return Tags(tuple(wanted.tags), wanted.filter_mode == TagsFilter.FILTER_MODE_ALL)
