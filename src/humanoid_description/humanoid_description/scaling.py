# SPDX-License-Identifier: Apache-2.0
"""Scaling rules for robots of other sizes, from config/scaling.yaml."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from humanoid_description.errors import DescriptionError
from humanoid_description.expansion import load_config


@dataclass(frozen=True)
class Scaling:
    """The range of the scale, and the exponent of the scale by which each quantity grows."""

    smallest: float
    largest: float
    exponents: Mapping[str, Any]
    """By quantity; those of joints by type of joint and quantity."""

    def joint_factor(self, kind: str, quantity: str, scale: float) -> float:
        """
        Compute the factor of a joint quantity in a robot of another size.

        Parameters
        ----------
        kind
            The type of the joint: `revolute` or `prismatic`.
        quantity
            Such as `effort`, `velocity` or `kp`: the names are those in scaling.yaml.
        scale
            The size of the robot relative to the model at 1.0.

        Raises
        ------
        DescriptionError
            The scale is out of range.

        """
        self.check(scale)
        return float(scale ** self.exponents[kind][quantity])

    def check(self, scale: float) -> None:
        """
        Reject a scale that is out of range.

        Parameters
        ----------
        scale
            The size of the robot relative to the model at 1.0.

        Raises
        ------
        DescriptionError
            The scale is less than the smallest or more than the largest.

        """
        if not self.smallest <= scale <= self.largest:
            raise DescriptionError(
                f'The scale {scale:g} is out of range. '
                f'Give one from {self.smallest} to {self.largest}.'
            )


def load_scaling() -> Scaling:
    """Load the installed scaling rules."""
    return Scaling(**load_config('scaling.yaml'))
