# SPDX-License-Identifier: Apache-2.0
"""Demos of the quality of service: each shows one policy with a talker and a listener."""
