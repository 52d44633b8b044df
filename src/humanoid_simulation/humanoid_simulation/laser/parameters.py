# SPDX-License-Identifier: Apache-2.0
"""The parameters of the laser scanners, to be inherited by those of the simulator."""

from __future__ import annotations

from dataclasses import dataclass

from humanoid_common.parameters import parameter
from humanoid_simulation.laser.scanner import ScanPattern


@dataclass(frozen=True)
class LaserParameters:
    """Rate, rays and range of the laser scanners; their noise is with that of other sensors."""

    scan_rate_hz: float = parameter(
        10.0,
        'How often scan is published while somebody subscribes; 0 is never.',
        at_least=0.0,
        at_most=100.0,
    )
    scan_rays: int = parameter(
        360, 'How many rays a sweep has, all round.', at_least=4, at_most=4096, read_only=True
    )
    scan_range_min_m: float = parameter(
        0.1, 'The nearest that is measured.', at_least=0.0, at_most=0.9, read_only=True
    )
    scan_range_max_m: float = parameter(
        12.0, 'The farthest that is measured.', at_least=1.0, at_most=100.0, read_only=True
    )

    @property
    def scan_pattern(self) -> ScanPattern:
        """Return the scan pattern that the parameters describe."""
        return ScanPattern(self.scan_rays, self.scan_range_min_m, self.scan_range_max_m)
