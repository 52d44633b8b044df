# SPDX-License-Identifier: Apache-2.0
"""Common start-up of both nodes: load the skills and named places from the same parameters."""

from __future__ import annotations

from dataclasses import dataclass

from humanoid_common.errors import UserError
from humanoid_common.parameters import parameter
from humanoid_perception.places import Places
from humanoid_perception.places_file import load_places, places_path
from llm_planner.rules import RulePlanner
from llm_planner.skills_file import load_skills, skills_path
from llm_planner.world_watch import WorldWatch
from rclpy.node import Node

__all__ = ['KnowledgeParameters', 'begin_watch']


@dataclass(frozen=True)
class KnowledgeParameters:
    """The parameters that both nodes share."""

    skills_file: str = parameter(
        '', 'The skills file; empty for the one in llm_planner.', read_only=True
    )
    places_file: str = parameter(
        '',
        'The named places: a YAML file, or the name of one in humanoid_perception (apartment).',
        read_only=True,
    )


def begin_watch(
    node: Node, told: KnowledgeParameters, implemented: frozenset[str]
) -> tuple[RulePlanner, WorldWatch]:
    """
    Create the rule planner, and the observer of the world that it plans in.

    Parameters
    ----------
    node
        The node that subscribes; its name appears in error messages.
    told
        The parameters with the files to load.
    implemented
        The names of the implemented skills; the robot cannot be asked for others.

    Raises
    ------
    UserError
        A file cannot be loaded.

    """
    try:
        skills, path = load_skills(skills_path(told.skills_file)), places_path(told.places_file)
        places = load_places(path) if path else Places()
    except UserError as error:
        raise UserError(f'{node.get_name()} cannot start. {error}') from error
    return RulePlanner(skills), WorldWatch(node, skills, places, implemented)
