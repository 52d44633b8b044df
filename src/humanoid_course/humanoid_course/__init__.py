# SPDX-License-Identifier: Apache-2.0
"""Check the packages that students write for the exercises of the course."""
