# SPDX-License-Identifier: Apache-2.0
"""Adaptive Monte Carlo localisation (AMCL) of a robot in a known map with a laser scanner."""
