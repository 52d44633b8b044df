# SPDX-License-Identifier: Apache-2.0
"""The laser scanners of the simulated robots."""

from humanoid_simulation.laser.scanner import LaserScanner, ScanNoise, ScanPattern

__all__ = ['LaserScanner', 'ScanNoise', 'ScanPattern']
