# SPDX-License-Identifier: Apache-2.0
"""Localise a robot in a known map with a laser scanner: adaptive Monte Carlo localisation."""
