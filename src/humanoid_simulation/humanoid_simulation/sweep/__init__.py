# SPDX-License-Identifier: Apache-2.0
"""Sweeps: many simulated walks under varied conditions, with one table of their results."""

ENVIRONMENT = {'OPENBLAS_NUM_THREADS': '1', 'OMP_NUM_THREADS': '1', 'MUJOCO_GL': 'disable'}
"""
Environment variables of each process that does runs.

One thread is also faster with matrices this small; nothing is rendered.
"""
