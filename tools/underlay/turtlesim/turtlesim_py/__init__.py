# SPDX-License-Identifier: Apache-2.0
"""Turtles that draw, on a page in the browser: the programs of the package turtlesim."""
