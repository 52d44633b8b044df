# SPDX-License-Identifier: Apache-2.0
"""The particles of AMCL, read from messages and shown: possible poses and their weights."""

from __future__ import annotations

import struct
from types import SimpleNamespace
from typing import Any, NamedTuple

from nav2_rviz_plugins.interfaces import interface, MISSING
import numpy as np
from numpy.typing import NDArray
from rviz_common.canvas import Canvas
from rviz_common.properties import Choice, ColorOf, Number, topic_properties
from rviz_common.status import Level
from rviz_common.topic_display import MessageDisplay
from rviz_default_plugins.bodies import add_copies, add_lines, arrow
from rviz_default_plugins.decoding.geometry import matrices_of, Points

__all__ = ['ParticleCloud', 'ParticleMessage', 'lengths_of', 'read_particles']

HEADER = 4
"""The size in bytes of the CDR encapsulation before the data, from which alignment counts."""
ROW = 8
"""Row layout: position, orientation x, y, z, w, and the weight."""

Floats = NDArray[np.float64]

FLAT, SOLID, AXES = 'Arrow (Flat)', 'Arrow (3D)', 'Axes'
MOST = 20000
HEAD = 0.2
"""The length of an arrow's head, as a fraction of the arrow's length."""


class ParticleMessage(NamedTuple):
    """
    Particle cloud.

    `poses` has a row for each: x, y, z in metres, and the quaternion x, y, z, w.
    """

    header: Any
    poses: Floats
    weights: Floats


def read_particles(data: bytes) -> ParticleMessage:
    """
    Deserialize a `nav2_msgs/msg/ParticleCloud`.

    rclpy would create four Python objects for each of thousands of particles; the serialized
    message has them as rows of eight doubles, which numpy reads at once.

    Parameters
    ----------
    data
        The message in CDR, as from a raw subscription.

    Returns
    -------
    ParticleMessage
        The header (stamp and frame_id), poses (N, 7) and weights (N,).

    Raises
    ------
    ValueError
        The bytes are not such a message.

    """
    order = '<' if len(data) > 1 and data[1] & 1 else '>'
    try:
        sec, nanosec, length = struct.unpack_from(f'{order}iII', data, HEADER)
        begin = HEADER + 12
        frame_id = data[slice(begin, begin + length - 1)].decode()
        at = _aligned(begin + length, 4)
        (count,) = struct.unpack_from(f'{order}I', data, at)
        at = _aligned(at + 4, 8) if count else at
        rows = np.frombuffer(data, f'{order}f8', count * ROW, at).reshape(count, ROW)
    except (struct.error, ValueError) as error:
        raise ValueError(f'its {len(data)} bytes are not a ParticleCloud: {error}.') from error
    stamp = SimpleNamespace(sec=sec, nanosec=nanosec)
    header = SimpleNamespace(stamp=stamp, frame_id=frame_id)
    return ParticleMessage(header, rows[:, :7].astype(float), rows[:, 7].astype(float))


def _aligned(offset: int, size: int) -> int:
    """Align an offset to a multiple of a size, counted after the encapsulation."""
    return HEADER + -(-(offset - HEADER) // size) * size


class ParticleCloud(MessageDisplay):
    """The newest particles of a localization; the likelier one is, the longer is its arrow."""

    CLASS = 'nav2_rviz_plugins/ParticleCloud'
    PROPERTIES = (
        *topic_properties('nav2_msgs/msg/ParticleCloud', '/particle_cloud'),
        Choice('Shape', FLAT, 'What shows a particle.', (FLAT, SOLID, AXES)),
        ColorOf('Color', (0, 180, 0), 'Colour of the arrows.'),
        Number('Alpha', 1.0, '0 is transparent; flat arrows are opaque.', 0.0, 1.0),
        Number('Min Arrow Length', 0.02, 'That of particles of no weight, in metres.', 0.0),
        Number('Max Arrow Length', 0.3, 'That of the greatest weight, in metres.', 0.0),
        Number('Head Length', 0.07, 'Length of heads of 3D arrows, in metres.', 0.0),
        Number('Head Radius', 0.03, 'Radius of heads of 3D arrows, in metres.', 0.0),
        Number('Shaft Length', 0.23, 'Length of shafts of 3D arrows, in metres.', 0.0),
        Number('Shaft Radius', 0.01, 'Radius of shafts of 3D arrows, in metres.', 0.0),
        Number('Axes Length', 0.3, 'Length of axes, in metres.', 0.0),
        Number('Axes Radius', 0.01, 'Radius of axes, in metres.', 0.0),
    )

    def start(self) -> None:
        """Subscribe to the topic, if its type is available."""
        self._canvas = Canvas(self.context.scene, self.root)
        try:
            super().start()
        except ImportError:
            self.status.say('Topic', Level.ERROR, MISSING)

    def message_type(self, topic: str) -> type:
        """
        Return the type `nav2_msgs/msg/ParticleCloud`.

        Parameters
        ----------
        topic
            The topic of the display; the type is the same for all.

        Raises
        ------
        ImportError
            nav2_msgs is not built; the text is a full sentence.

        """
        kind: type = interface('msg', 'ParticleCloud')
        return kind

    def subscribe(self, kind: Any, topic: str, take: Any, *more: Any, **options: Any) -> bool:
        """
        Subscribe to a topic for serialized messages, until the display stops.

        Parameters
        ----------
        kind, topic
            The type of the messages, and the name of the topic.
        take
            Called with the bytes of each message.
        *more, **options
            As for `TopicDisplay.subscribe`.

        Returns
        -------
        bool
            Whether the topic could be subscribed.

        """
        return super().subscribe(kind, topic, take, *more, raw=True, **options)

    def take(self, message: Any) -> None:
        """
        Deserialize a message, and keep it for the next frame.

        Parameters
        ----------
        message
            The bytes of the message in CDR; invalid ones are reported in the status.

        """
        try:
            super().take(read_particles(message))
        except ValueError as error:
            self.say_left_out(error)

    def show(self, message: ParticleMessage) -> None:
        """
        Draw all particles as one object.

        Parameters
        ----------
        message
            The particles, of which at most 20 000 are drawn.

        """
        poses, weights = self._usable(message)
        with self._canvas.anew():
            if not len(poses):
                return
            positions = poses[:, :3].astype(np.float32)
            wxyzs = poses[:, [6, 3, 4, 5]].astype(np.float32)
            self._draw(positions, wxyzs, self._lengths(weights))

    def _usable(self, message: ParticleMessage) -> tuple[NDArray[Any], NDArray[Any]]:
        """Return the poses and weights that can be shown, and report the number of others."""
        poses, weights = message.poses, message.weights
        norms = np.linalg.norm(poses[:, 3:], axis=1)
        valid = np.isfinite(poses).all(axis=1) & np.isfinite(weights) & (norms > 1e-6)
        step = max(1, -(-len(poses) // MOST))
        if lost := int((~valid).sum()):
            self.status.say(
                'Particles',
                Level.WARN,
                f'{lost} of {len(poses)} particles are left out: they have numbers that are not '
                'finite, or quaternions of zeros.',
            )
        elif step > 1:
            shown = f'{len(poses[::step])} of {len(poses)} particles are shown.'
            self.status.say('Particles', Level.WARN, shown)
        else:
            self.status.forget('Particles')
        poses = poses.copy()
        poses[valid, 3:] /= norms[valid, None]
        return poses[valid][::step], weights[valid][::step]

    def _lengths(self, weights: NDArray[Any]) -> NDArray[np.float32]:
        low, high = self.values['Min Arrow Length'], self.values['Max Arrow Length']
        return lengths_of(weights, low, max(low, high))

    def _draw(self, positions: Points, wxyzs: Points, lengths: NDArray[np.float32]) -> None:
        shape = self.values['Shape']
        if shape == FLAT:
            self._add_flat(positions, wxyzs, lengths)
        elif shape == SOLID:
            names = ('Shaft Length', 'Shaft Radius', 'Head Length', 'Head Radius')
            surface = arrow(*(self.values[name] for name in names))
            paint = self.values['Color'], self.values['Alpha']
            add_copies(self._canvas, 'arrows', surface, paint, positions, wxyzs)
        else:
            self._canvas.put(
                'batched_axes',
                'axes',
                batched_wxyzs=wxyzs,
                batched_positions=positions,
                axes_length=self.values['Axes Length'],
                axes_radius=self.values['Axes Radius'],
            )

    def _add_flat(self, positions: Points, wxyzs: Points, lengths: NDArray[np.float32]) -> None:
        """Add flat arrows made of lines: a shaft and two for the head."""
        tip, back, side = (1.0, 0.0, 0.0), 1.0 - HEAD, HEAD / 2.0
        lines = [((0, 0, 0), tip), (tip, (back, side, 0)), (tip, (back, -side, 0))]
        ends = np.array(lines, np.float32).reshape(-1, 3)
        turned = ends @ matrices_of(wxyzs).transpose(0, 2, 1)
        segments = turned * lengths[:, None, None] + positions[:, None]
        add_lines(
            self._canvas,
            'lines',
            segments.astype(np.float32).reshape(-1, 2, 3),
            self.values['Color'],
        )


def lengths_of(weights: NDArray[Any], shortest_m: float, longest_m: float) -> NDArray[np.float32]:
    """
    Compute the arrow lengths of particles.

    The length is proportional to the weight, relative to the maximum; particles of equal weight,
    as after resampling, have the longest arrow.

    Parameters
    ----------
    weights
        (N,) weights of the particles.
    shortest_m, longest_m
        The limits of the length in m; the maximum weight has the longest.

    Returns
    -------
    numpy.ndarray
        (N,) lengths in m.

    """
    greatest = float(weights.max(initial=0.0))
    parts = weights / greatest if greatest > 0.0 else np.ones_like(weights)
    lengths: NDArray[np.float32] = np.clip(parts * longest_m, shortest_m, longest_m)
    return lengths.astype(np.float32)
