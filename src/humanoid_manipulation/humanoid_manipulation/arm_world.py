# SPDX-License-Identifier: Apache-2.0
"""
Collision checking of the arms: with the body, each other, and the obstacles around the robot.

MuJoCo finds the contacts: it treats boxes, cylinders and capsules exactly, and takes some
microseconds per posture. Only kinematics is used; no dynamics is simulated.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
import math
from typing import Any

from humanoid_control.dynamics.frames import Frame
from humanoid_description.drives import SIDES
from humanoid_description.loading import load_robot
from humanoid_description.rotations import quaternion_of
from humanoid_manipulation.obstacle import Obstacle
from humanoid_manipulation.upper_body import Reach, UpperBody
import mujoco

__all__ = ['ArmWorld', 'CollisionPair']

_ARM_LINKS = ('upper_arm', 'forearm', 'palm', 'finger', 'thumb')
_NEVER = (('finger', 'thumb'), ('forearm', 'palm'))
"""Pairs of links of an arm that overlap or touch by design."""
_COMPILER = '<mujoco><compiler fusestatic="false" discardvisual="true"/></mujoco></robot>'


@dataclass(frozen=True)
class CollisionPair:
    """A pair of shapes nearer to each other than allowed; a negative distance is penetration."""

    one: str
    other: str
    distance_m: float

    @property
    def names(self) -> frozenset[str]:
        """Return the names of the pair."""
        return frozenset((self.one, self.other))

    def __str__(self) -> str:
        """Return the text for messages."""
        return f"'{self.one}' would touch '{self.other}'"


@dataclass(eq=False)
class ArmWorld:
    """
    Collision checker for the arms of a robot.

    Parameters
    ----------
    urdf
        The URDF of the robot.
    body
        Its upper body.
    obstacles
        The obstacles around it.
    held
        The boxes of held objects, each in its gripper frame, by side.
    clearance_m
        The distance below which a pair counts as a contact.

    """

    urdf: str
    body: UpperBody
    obstacles: Sequence[Obstacle] = ()
    held: Mapping[str, Obstacle] = field(default_factory=dict)
    clearance_m: float = 0.01

    def __post_init__(self) -> None:
        """Build the MuJoCo model."""
        self._robot = load_robot(self.urdf, 'the robot')
        spec = mujoco.MjSpec.from_string(self.urdf.replace('</robot>', _COMPILER))
        prefix = self._robot.prefix
        for geom in spec.geoms:
            is_arm = geom.parent.name.endswith(_ARM_LINKS)
            geom.contype, geom.conaffinity = int(is_arm), 1
            geom.margin = self.clearance_m
        for side in SIDES:
            for one, other in _NEVER:
                spec.add_exclude(
                    bodyname1=f'{prefix}{side}_{one}', bodyname2=f'{prefix}{side}_{other}'
                )
        for number, obstacle in enumerate(self.obstacles):
            body = spec.worldbody.add_body(name=f'obstacle {number}')
            self._add_box(body, obstacle, obstacle.middle, contype=0)
        for side, thing in self.held.items():
            self._add_box(spec.body(self.body.arms[side].gripper), thing, thing.middle, contype=1)
        self._model = spec.compile()
        self._data = mujoco.MjData(self._model)
        self._names = [self._name(geom) for geom in range(self._model.ngeom)]
        self._places = {
            side: [self._place(joint) for joint in (self.body.waist, *arm.joints)]
            for side, arm in self.body.arms.items()
        }

    def stand(self, positions: Mapping[str, float]) -> None:
        """
        Set the joint positions of the robot, from which `contacts` moves one arm.

        Parameters
        ----------
        positions
            Positions by joint name, in rad or m; other joints keep theirs.

        """
        for joint in self._robot.joints:
            mimics = joint.mimics
            if joint.name in positions:
                self._data.qpos[self._place(joint.name)] = positions[joint.name]
            elif mimics is not None and mimics.joint in positions:
                self._data.qpos[self._place(joint.name)] = (
                    mimics.multiplier * positions[mimics.joint] + mimics.offset
                )

    def contacts(self, side: str, reach: Reach) -> list[CollisionPair]:
        """
        Find the contacts of the arms in a posture of one of them.

        The arm and the waist keep that posture afterwards; all other joints stay where `stand`
        has set them.

        Parameters
        ----------
        side
            `left` or `right`: the arm to move.
        reach
            The waist angle and the posture of that arm.

        Returns
        -------
        list of CollisionPair
            Pairs that involve an arm and are nearer to each other than `clearance_m`.

        """
        data = self._data
        data.qpos[self._places[side]] = (reach.waist_rad, *reach.posture)
        mujoco.mj_kinematics(self._model, data)
        mujoco.mj_collision(self._model, data)
        found = zip(data.contact.geom.tolist(), data.contact.dist.tolist())
        return [
            CollisionPair(self._names[one], self._names[other], distance_m)
            for (one, other), distance_m in found
            if distance_m < self.clearance_m
        ]

    def is_free(self, side: str, reach: Reach, but: Mapping[frozenset[str], float] = {}) -> bool:
        """
        Check whether a posture is collision-free.

        Parameters
        ----------
        side, reach
            The side of the arm, and its posture.
        but
            The least allowed distance of pairs of names (m), instead of the clearance; negative
            allows penetration.

        """
        return all(
            contact.distance_m >= but.get(contact.names, math.inf)
            for contact in self.contacts(side, reach)
        )

    def _add_box(self, body: Any, box: Obstacle, at: Frame, contype: int) -> None:
        """Add a box to a body."""
        body.add_geom(
            type=mujoco.mjtGeom.mjGEOM_BOX,
            size=[edge / 2.0 for edge in box.size_m],
            pos=at.position_m,
            quat=quaternion_of(at.rotation),
            contype=contype,
            conaffinity=1 - contype,
            margin=self.clearance_m,
        )

    def _name(self, geom: int) -> str:
        """Return the name of a geom in messages."""
        body = self._model.body(int(self._model.geom_bodyid[geom])).name
        if body.startswith('obstacle '):
            return self.obstacles[int(body.split()[1])].name
        for side, thing in self.held.items():
            if body == self.body.arms[side].gripper:
                return thing.name
        return str(body)

    def _place(self, joint: str) -> int:
        """Return the index of a joint in `qpos`."""
        return int(self._model.joint(joint).qposadr[0])
