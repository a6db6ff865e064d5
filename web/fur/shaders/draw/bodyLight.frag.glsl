flat in uvec4 vEntry0;
flat in uvec4 vEntry1;
flat in uvec4 vEntry2;

layout(location = 0) out uvec4 entry0;
layout(location = 1) out uvec4 entry1;
layout(location = 2) out uvec4 entry2;

void main() {
	entry0 = vEntry0;
	entry1 = vEntry1;
	entry2 = vEntry2;
}
