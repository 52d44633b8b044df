# SPDX-License-Identifier: Apache-2.0
"""Editing of service requests."""
