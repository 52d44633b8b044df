# SPDX-License-Identifier: Apache-2.0
"""Conversions between messages and the types of the simulator."""

from __future__ import annotations

from typing import Any

from geometry_msgs.msg import Point, Vector3
from humanoid_control.backends import Array
from humanoid_interfaces.msg import Contact as ContactMessage
from humanoid_simulation.backend import Contact, EntityState
import numpy as np
from simulation_interfaces.msg import EntityState as EntityStateMessage


def entity_state(message: EntityStateMessage) -> EntityState:
    """
    Convert a message to an EntityState, without its header and its accelerations.

    Parameters
    ----------
    message
        Pose and twist, both in the frame of its header.

    Returns
    -------
    EntityState
        Still in the frame of the header; accelerations are zero.

    Raises
    ------
    SimulationError
        A number is not finite, or the quaternion is not normalised.

    """
    pose, twist = message.pose, message.twist
    q = pose.orientation
    return EntityState(
        vector(pose.position),
        np.array([q.w, q.x, q.y, q.z]),
        vector(twist.linear),
        vector(twist.angular),
    )


def contact_message(contact: Contact) -> ContactMessage:
    """
    Convert a contact to its message, in world axes like the contact.

    Parameters
    ----------
    contact
        A contact of the simulated world.

    """
    x, y, z = contact.position_m.tolist()
    return ContactMessage(
        body1=contact.body1,
        body2=contact.body2,
        position=Point(x=x, y=y, z=z),
        normal=_vector_message(contact.normal),
        force=_vector_message(contact.force_n),
    )


def vector(message: Any) -> Array:
    """
    Convert a geometry message with x, y and z to an array (3,).

    Parameters
    ----------
    message
        A `Point` or a `Vector3`.

    """
    return np.array([message.x, message.y, message.z])


def _vector_message(values: Array) -> Vector3:
    """Convert an array (3,) to a Vector3 message."""
    x, y, z = values.tolist()
    return Vector3(x=x, y=y, z=z)
