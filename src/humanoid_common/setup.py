# SPDX-License-Identifier: Apache-2.0
"""Install humanoid_common."""

from __future__ import annotations

from setuptools import find_packages, setup

package_name = 'humanoid_common'

setup(
    name=package_name,
    version='0.1.0',
    packages=find_packages(exclude=['test']),
    package_data={'': ['py.typed']},
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml']),
    ],
    install_requires=['setuptools'],
    extras_require={'test': ['pytest']},
    zip_safe=False,
    maintainer='Humanoid workspace maintainers',
    maintainer_email='maintainers@humanoid-workspace.dev',
    description=(
        'What every node of the humanoid shares: running, parameters, quality of service '
        'and test helpers'
    ),
    license='Apache-2.0',
)
