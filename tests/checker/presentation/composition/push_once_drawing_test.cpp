// The third composition (tests/model/push_once) is drawn as the others are.
#include <gtest/gtest.h>

#include "checker/presentation/composition/composition_drawing.hpp"
#include "checker/presentation/document/render.hpp"
#include "fsm/program/record.hpp"
#include "fsm/program/words.hpp"
#include "tests/model/push_once/push_once.hpp"

namespace stormproof::draw {
namespace push_once_drawing_test {

TEST(PushOnceDrawing, NamesEveryRuleInEveryForm) {
  const auto composition =
      words_of(fsm::program::recorded<fsm::composition::push_once::PushOnce>());
  const std::string text = to_text(composition_document(composition));
  const std::string svg = composition_svg(composition);
  const std::string mermaid = composition_mermaid(composition);
  for (const fsm::composition::RuleInfo& rule : composition.rules) {
    for (const std::string* form : {&text, &svg, &mermaid}) {
      EXPECT_NE(form->find(rule.id), std::string::npos) << rule.id;
    }
  }
}

}  // namespace push_once_drawing_test
}  // namespace stormproof::draw
