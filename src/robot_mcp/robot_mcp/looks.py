# SPDX-License-Identifier: Apache-2.0
"""Content of the read-only tools, as data for JSON."""

from __future__ import annotations

import json
import math
from typing import Any

from llm_planner.skills import Skills
from llm_planner.world import base_name, World

__all__ = ['named_places', 'remembered_objects', 'robot_state']

_MOST_OBJECTS = 200


def robot_state(
    skills: Skills,
    world: World,
    room: str,
    walking: str,
    plan: str,
    lack: str,
    *,
    may_move: bool,
) -> dict[str, Any]:
    """
    Report the state of the robot: its pose, and what it can do.

    Parameters
    ----------
    skills, world
        The skills, and the state of the world.
    room
        The room of the robot; empty if it is unknown.
    walking
        The state reported by the walking controller: `standing`, `walking`, `fallen`, ...
    plan
        The current or last plan, as reported by the executor: JSON.
    lack
        Why the robot can do nothing at all; empty if it can.
    may_move
        Whether assistants may move the robot.

    """
    missing = world.missing
    pose = None
    if world.robot is not None:
        x, y, yaw = world.robot
        pose = {'x_m': round(x, 2), 'y_m': round(y, 2), 'yaw_deg': round(math.degrees(yaw))}
    return {
        'pose_in_map': pose,
        'room': room or None,
        'walking_state': walking or None,
        'cannot_move_because': lack or world.inhibition or None,
        'holding': world.holding or None,
        'last_plan': _plan(plan),
        'assistants_may_move_it': may_move,
        'can': [
            each.name for each in skills if not lack and not skills.simple(each.name) & {*missing}
        ],
        'cannot': dict(missing),
    }  # fmt: skip


def remembered_objects(world: World) -> list[dict[str, Any]]:
    """
    List the remembered objects, in the words by which tools can refer to them.

    Parameters
    ----------
    world
        The state of the world.

    Returns
    -------
    list of dict
        The id, class, colour, place, room and position (m, in the map) of 200 objects at most.

    """
    return [
        {
            'id': each.object_id,
            'class': each.class_id,
            'colour': each.colour or None,
            'place': base_name(each.place) or None,
            'room': each.room or None,
            'position_m': [round(value, 2) for value in each.position_m],
        }
        for each in world.things[:_MOST_OBJECTS]
    ]


def named_places(world: World) -> dict[str, Any]:
    """
    List the rooms, and the places with the rooms in which they are.

    Parameters
    ----------
    world
        The state of the world.

    Returns
    -------
    dict
        `rooms`, a list of names, and `places`: for each name its room, or None.

    """
    return {
        'rooms': list(world.rooms),
        'places': {name: room or None for name, room in world.places.items()},
    }


def _plan(text: str) -> Any:
    """Parse the plan state that the executor reports; None if there is none."""
    try:
        return json.loads(text) if text else None
    except ValueError:
        return None
