# SPDX-License-Identifier: Apache-2.0
"""The parameters of the sensor processor."""

from __future__ import annotations

from dataclasses import dataclass

from humanoid_common.parameters import parameter


@dataclass(frozen=True)
class SensorProcessorParameters:
    """Report period of the sensor processor."""

    report_period_s: float = parameter(
        1.0, 'The least time between two reports.', at_least=0.1, at_most=3600.0
    )
