"""Ways to break a character, and the sentence that each is told with."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from helpers.characters import Character, bent_tube, turn

SPIN = [turn([1, 0, 0], angle).tolist() for angle in (0, 60, 120)]


def character() -> Character:
    """A bent tube with two targets, a clip of its joints and one of its targets."""
    made = bent_tube()
    count = len(made.numbers[0])
    chance = np.random.default_rng(1)
    made.primitive(0)["targets"] = [{"POSITION": made.add(chance.normal(size=(count, 3)))} for _ in range(2)]
    made.clip("bend", (2, "rotation", [0, 1, 2], SPIN, "LINEAR"), (3, "rotation", [0, 1, 2], SPIN, "LINEAR"))
    made.clip("swell", (5, "weights", [0, 1, 2], [[0, 0], [1, 0], [0, 1]], "LINEAR"))
    return made


def keys(made: Character, which: str, values: Any, clip: int = 0) -> None:
    """Other numbers in the first sampler of a clip."""
    sampler = made.json["animations"][clip]["samplers"][0]
    sampler[which] = made.add(values, scalars=which == "input" or clip == 1)


def attribute(made: Character, name: str, values: Any, kind: str = "float32") -> None:
    made.primitive(0)["attributes"][name] = made.add(values, kind)


def weights(change: Callable[[Any], None]) -> Callable[[Character], None]:
    def broken(made: Character) -> None:
        values = made.numbers[made.primitive(0)["attributes"]["WEIGHTS_0"]].copy()
        change(values)
        attribute(made, "WEIGHTS_0", values)

    return broken


def weightless(values: Any) -> None:
    values[:7] = 0.0


def below_zero(values: Any) -> None:
    values[3, 1], values[4, 2] = np.nan, -1.0


def out_of_range(made: Character) -> None:
    joints = made.numbers[made.primitive(0)["attributes"]["JOINTS_0"]].copy()
    joints[:5, 0], joints[6, 3] = 200, 9  # the last one has no weight
    attribute(made, "JOINTS_0", joints, "uint8!")


def no_joints(made: Character) -> None:
    made.json["skins"][0]["joints"] = []


def no_skin(made: Character) -> None:
    made.json["nodes"][5]["skin"] = 7


def strange_joints(made: Character) -> None:
    made.json["skins"][0]["joints"] = [2, 99, "tail"]


def outside(made: Character) -> None:
    made.json["nodes"].append({"name": "nowhere"})
    made.json["skins"][0]["joints"][2] = 6


def flat_bind(made: Character) -> None:
    inverse = np.array([np.eye(4)] * 3)
    inverse[1] = 0.0
    inverse[2, 0, 0] = np.nan
    made.json["skins"][0]["inverseBindMatrices"] = made.add(inverse)


def short_bind(made: Character) -> None:
    made.json["skins"][0]["inverseBindMatrices"] = made.add(np.array([np.eye(4)]))


def no_bind(made: Character) -> None:
    made.json["skins"][0]["inverseBindMatrices"] = 999


def nan_times(made: Character) -> None:
    keys(made, "input", [0, np.nan, 2])


def nan_values(made: Character) -> None:
    keys(made, "output", [SPIN[0], [np.nan] * 4, SPIN[2]])


def no_turn(made: Character) -> None:
    keys(made, "output", [SPIN[0], [0, 0, 0, 0], SPIN[2]])


def falling(made: Character) -> None:
    keys(made, "input", [0, 2, 1])


def nothing_but_nan(made: Character) -> None:
    keys(made, "input", [np.inf, np.nan, -1.0])


def fewer_values(made: Character) -> None:
    keys(made, "output", SPIN[:2])


def other_weights(made: Character) -> None:
    keys(made, "output", [0.0, 1.0, 2.0, 3.0, 4.0], clip=1)


def no_sampler(made: Character) -> None:
    made.json["animations"][0]["channels"][0]["sampler"] = -1


def no_accessor(made: Character) -> None:
    made.json["animations"][0]["samplers"][0]["input"] = 999


def no_target(made: Character) -> None:
    del made.json["animations"][0]["channels"][0]["target"]


def strange_kind(made: Character) -> None:
    made.json["animations"][0]["samplers"][0]["interpolation"] = "WARP"


def aims(**target: Any) -> Callable[[Character], None]:
    def broken(made: Character) -> None:
        made.json["animations"][0]["channels"][0]["target"] = target

    return broken


def aims_at_nothing(made: Character) -> None:
    for channel in made.json["animations"][0]["channels"]:
        channel["target"]["node"] = 99


def twice(made: Character) -> None:
    made.json["animations"][0]["channels"][1]["target"]["node"] = 2


def strange_clips(made: Character) -> None:
    made.json["animations"] += [None, 7, {"channels": {"a": 1}}, {}]


def long_target(made: Character) -> None:
    made.primitive(0)["targets"][0]["POSITION"] = made.add(np.ones((7, 3)))


def nan_target(made: Character) -> None:
    made.primitive(0)["targets"][1]["POSITION"] = made.add(np.full((len(made.numbers[0]), 3), np.nan))


def no_target_numbers(made: Character) -> None:
    made.primitive(0)["targets"] = [{"POSITION": 999}, None]


REPAIRED = {
    weights(weightless): "7 vertices without a weight follow their first joint",
    weights(below_zero): "2 vertices with weights below 0 or not finite, which are left out",
    out_of_range: "5 vertices with joints that their skin does not have",
    no_joints: "1 skin without joints left out",
    no_skin: "1 skin without joints left out",
    strange_joints: "2 joints outside of the scene stand still",
    outside: "1 joint outside of the scene stands still",
    flat_bind: "2 inverse bind matrices that cannot be inverted replaced by those of the rest pose",
    short_bind: "2 inverse bind matrices that cannot be inverted replaced by those of the rest pose",
    no_bind: "3 inverse bind matrices that cannot be inverted replaced by those of the rest pose",
    nan_times: "1 key of a clip that is not finite or does not follow the one before it left out",
    nan_values: "1 key of a clip that is not finite or does not follow the one before it left out",
    no_turn: "1 key of a clip that is not finite or does not follow the one before it left out",
    falling: "1 key of a clip that is not finite or does not follow the one before it left out",
    nothing_but_nan: "1 channel that cannot be read left out",
    fewer_values: "1 channel that cannot be read left out",
    other_weights: "1 channel that cannot be read left out",
    no_sampler: "1 channel that cannot be read left out",
    no_accessor: "1 channel that cannot be read left out",
    no_target: "1 channel that cannot be read left out",
    strange_kind: "1 channel that cannot be read left out",
    aims(node=2, path="colour"): "1 channel of another path than node transforms and weights left out",
    aims(path="pointer", extensions={"KHR_animation_pointer": {"pointer": "/materials/0"}}): (
        "1 channel of another path than node transforms and weights left out"
    ),
    aims(node=99, path="rotation"): "1 channel that moves nothing of the body left out",
    aims(path="rotation"): "1 channel that moves nothing of the body left out",
    aims(node=2, path="weights"): "1 channel that moves nothing of the body left out",
    aims_at_nothing: "1 clip that moves nothing of the body left out",
    twice: "1 channel left out that its clip has twice",
    strange_clips: "4 clips that move nothing of the body left out",
    long_target: "1 morph target of another length or with numbers that are not finite left out",
    nan_target: "1 morph target of another length or with numbers that are not finite left out",
    no_target_numbers: "2 morph targets of another length or with numbers that are not finite left out",
}
