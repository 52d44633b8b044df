# SPDX-License-Identifier: Apache-2.0
"""Publishes and shows images, to try the quality of service with them."""
