extends Node3D
# A walker, and a slider for the strength of each of three styles.

const STYLES: Array[String] = ["old", "joyful", "zombie"]
const MODEL := "res://addons/panache/models/panache-int8.safetensors"


func _ready() -> void:
	var player := _first("AnimationPlayer") as AnimationPlayer
	var walk: StringName = player.get_animation_list()[0]
	player.get_animation(walk).loop_mode = Animation.LOOP_LINEAR
	player.play(walk)
	if not ClassDB.class_exists("PanacheCharacter"):
		push_error("Panache is not loaded yet: close the project and open it again.")
		return
	var character: Node = ClassDB.instantiate("PanacheCharacter")
	_first("Skeleton3D").add_child(character)
	character.set("model_path", MODEL)
	for style in STYLES:
		_add_slider(character, style)


# The first node of this class in the walker.
func _first(type: String) -> Node:
	return $Walker.find_children("*", type, true, false)[0]


func _add_slider(character: Node, style: String) -> void:
	var label := Label.new()
	label.text = style
	var slider := HSlider.new()
	slider.max_value = 1.0
	slider.step = 0.01
	slider.value_changed.connect(
		func(value: float) -> void: character.set("styles/" + style, value))
	$Styles.add_child(label)
	$Styles.add_child(slider)
	slider.value = 1.0 if style == STYLES[0] else 0.0
