# SPDX-License-Identifier: Apache-2.0
"""The offered QoS of a publisher, as stored in a recording."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import yaml

__all__ = ['INFINITE_NS', 'OfferedQos', 'qos_from_text', 'qos_to_text']

INFINITE_NS = 2**63 - 1
NS_PER_S = 10**9
# rosbag2 wrote these policies as numbers before version 9.
HISTORIES = ('system_default', 'keep_last', 'keep_all', 'unknown')
RELIABILITIES = ('system_default', 'reliable', 'best_effort', 'unknown', 'best_available')
DURABILITIES = ('system_default', 'transient_local', 'volatile', 'unknown', 'best_available')
LIVELINESSES = (
    'system_default',
    'automatic',
    'unknown',
    'manual_by_topic',
    'unknown',
    'best_available',
)


@dataclass(frozen=True)
class OfferedQos:
    """One publisher's quality of service; policies are named as in rosbag2."""

    history: str = 'unknown'
    depth: int = 0
    reliability: str = 'reliable'
    durability: str = 'volatile'
    deadline_ns: int = INFINITE_NS
    lifespan_ns: int = INFINITE_NS
    liveliness: str = 'automatic'
    liveliness_lease_duration_ns: int = INFINITE_NS
    avoid_ros_namespace_conventions: bool = False

    @property
    def is_latched(self) -> bool:
        """Whether late subscribers get the last messages (transient local)."""
        return self.durability == 'transient_local'

    def to_dict(self) -> dict[str, Any]:
        """Return the mapping for `metadata.yaml`."""
        return {
            'history': self.history,
            'depth': self.depth,
            'reliability': self.reliability,
            'durability': self.durability,
            'deadline': _duration_to_dict(self.deadline_ns),
            'lifespan': _duration_to_dict(self.lifespan_ns),
            'liveliness': self.liveliness,
            'liveliness_lease_duration': _duration_to_dict(self.liveliness_lease_duration_ns),
            'avoid_ros_namespace_conventions': self.avoid_ros_namespace_conventions,
        }

    @classmethod
    def from_dict(cls, values: Mapping[str, Any]) -> OfferedQos:
        """
        Build a QoS from a mapping in the layout of rosbag2; missing policies have the defaults.

        Parameters
        ----------
        values
            Policies by name, or by number as before version 9; durations as mappings of `sec` and
            `nsec`.

        Raises
        ------
        KeyError, TypeError, ValueError
            A value is malformed.

        """
        default = cls()
        return cls(
            history=_policy(values.get('history', default.history), HISTORIES),
            depth=int(values.get('depth', default.depth)),
            reliability=_policy(values.get('reliability', default.reliability), RELIABILITIES),
            durability=_policy(values.get('durability', default.durability), DURABILITIES),
            deadline_ns=_duration_from(values.get('deadline')),
            lifespan_ns=_duration_from(values.get('lifespan')),
            liveliness=_policy(values.get('liveliness', default.liveliness), LIVELINESSES),
            liveliness_lease_duration_ns=_duration_from(values.get('liveliness_lease_duration')),
            avoid_ros_namespace_conventions=bool(
                values.get('avoid_ros_namespace_conventions', False)
            ),
        )


def qos_to_text(profiles: Iterable[OfferedQos]) -> str:
    """
    Serialize QoS profiles to the YAML that an MCAP channel stores.

    Parameters
    ----------
    profiles
        One per publisher.

    """
    return yaml.safe_dump([each.to_dict() for each in profiles], sort_keys=False)


def qos_from_text(text: str | list[Any]) -> tuple[OfferedQos, ...]:
    """
    Parse the QoS profiles of an MCAP channel or of `metadata.yaml`.

    Parameters
    ----------
    text
        YAML, or the parsed list, as in `metadata.yaml` since version 9.

    Returns
    -------
    tuple of OfferedQos
        One per publisher.

    Raises
    ------
    yaml.YAMLError, AttributeError, KeyError, TypeError, ValueError
        The text is malformed.

    """
    profiles = yaml.safe_load(text) if isinstance(text, str) else text
    return tuple(OfferedQos.from_dict(each) for each in profiles or ())


def _policy(value: str | int, names: tuple[str, ...]) -> str:
    if isinstance(value, str):
        return value.lower()
    return names[value] if 0 <= value < len(names) else 'unknown'


def _duration_to_dict(duration_ns: int) -> dict[str, int]:
    seconds, rest = divmod(duration_ns, NS_PER_S)
    return {'sec': seconds, 'nsec': rest}


def _duration_from(value: Mapping[str, int] | None) -> int:
    """Return nanoseconds; zero meant infinity in older recordings."""
    if not value:
        return INFINITE_NS
    return min(value['sec'] * NS_PER_S + value['nsec'], INFINITE_NS) or INFINITE_NS
