// All loops, by name. See common.h.
template <class Shader>
void over(const Batch& b) {
  for (int i = 0; i < kPoints; i += kWidth) Shader::shade({b, i});
}
#define LOOP(name) \
  { #name, over < name> }
constexpr Loop kLoops[] = {LOOP(wood),      LOOP(marble), LOOP(granite), LOOP(clouds), LOOP(brick),   LOOP(planks),
                           LOOP(cells),     LOOP(paint),  LOOP(ramp),    LOOP(tiles),  LOOP(plastic), LOOP(anisotropic),
                           LOOP(orennayar), LOOP(toon),   LOOP(checker), LOOP(bumps),  LOOP(decal),   LOOP(lamp),
                           LOOP(branches),  LOOP(julia),  LOOP(march)};
#undef LOOP
