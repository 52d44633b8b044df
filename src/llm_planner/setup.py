# SPDX-License-Identifier: Apache-2.0
"""Install llm_planner."""

from __future__ import annotations

from glob import glob

from setuptools import find_packages, setup

package_name = 'llm_planner'

setup(
    name=package_name,
    version='0.1.0',
    packages=find_packages(exclude=['test']),
    package_data={package_name: ['py.typed']},
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml']),
        ('share/' + package_name + '/config', glob('config/*')),
        ('share/' + package_name + '/launch', glob('launch/*.launch.*')),
    ],
    entry_points={
        'console_scripts': [
            'skill_executor = llm_planner.skill_executor:main',
            'task_planner = llm_planner.task_planner:main',
        ],
    },
    install_requires=['setuptools'],
    extras_require={'test': ['pytest']},
    zip_safe=True,
    maintainer='Humanoid workspace maintainers',
    maintainer_email='maintainers@humanoid-workspace.dev',
    description='Turns what somebody says into a plan, by rules or a language model, and does it',
    license='Apache-2.0',
)
