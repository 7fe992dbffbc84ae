#include "reyes/app/chart/html.h"

#include <fmt/format.h>

#include <cstdint>
#include <fstream>

#include "reyes/app/chart/plot.h"

namespace tomales {
namespace {

constexpr const char* kPageStyle = R"(
:root{font:16px/1.5 system-ui,sans-serif;color:#1b1b1b;background:#fff}
body{max-width:1200px;margin:0 auto;padding:0 16px 48px}
h1{font-size:1.5rem;margin:1.2em 0 .2em}h2{font-size:1.15rem;margin:2em 0 .5em}
h1,p,li{overflow-wrap:anywhere}p{max-width:46em;margin:.5em 0}code{font:12px/1.5 ui-monospace,monospace;overflow-wrap:anywhere}
a{color:#0058a3}
ul{margin:.3em 0;padding-left:1.2em;font-size:14px}
.scroll{overflow-x:auto}table{border-collapse:collapse;font-size:14px}
th,td{padding:3px 9px 3px 0;text-align:right;white-space:nowrap;border-bottom:1px solid #e4e4e4}
th:first-child,td:first-child,td.text,th.text{text-align:left}
tr.best td:first-child,td.first{font-weight:600}
.plots{display:grid;grid-template-columns:repeat(2,minmax(0,1fr));gap:24px}.plots h2{margin-top:1em}
.key{display:inline-block;width:.8em;height:.8em;border-radius:50%;margin:0 .35em 0 0}
.legend{display:flex;flex-wrap:wrap;gap:4px 20px;margin:.6em 0;padding:0;list-style:none;font-size:14px}
svg{display:block;width:100%;height:auto;font:12px system-ui,sans-serif}
.grid{stroke:#ececec}.axis{stroke:#555;fill:none}.tick,.label{fill:#333}.name{fill:#555;font-size:11px}
.curve,.whisker{fill:none;stroke-width:1.8}.point{stroke:#fff;stroke-width:1.2}.best{stroke:#111;stroke-width:2}
.front{fill:none;stroke:#ffd84d;stroke-width:9;stroke-linecap:round;stroke-linejoin:round;opacity:.55}
path.floor{stroke:#888;stroke-dasharray:3 4}text.floor{fill:#666}
path.limit{stroke:#b00020;stroke-dasharray:6 3}text.limit{fill:#b00020}.warned{fill:none;stroke:#b00020;stroke-width:1.5}
a:hover circle,a:focus circle{r:7px}
.picture{filter:url(#exposure)}#shown{image-rendering:pixelated;width:min(100%,600px);cursor:pointer}
.cards{display:grid;grid-template-columns:repeat(auto-fill,minmax(330px,1fr));gap:20px}
figure{margin:0;padding:10px;border:1px solid #e0e0e0;border-radius:6px}figure:target{outline:3px solid #ffd84d}
figure img{width:calc(50% - 3px);image-rendering:auto;vertical-align:top}
figcaption{font-size:13px}.narrow{display:none}
@media(max-width:800px){.plots{grid-template-columns:minmax(0,1fr)}.wide{display:none}.narrow{display:block}.cards{grid-template-columns:1fr}}
)";

constexpr const char* kPictureTools = R"(
<svg width="0" height="0" style="position:absolute" aria-hidden="true"><filter id="exposure" color-interpolation-filters="linearRGB" x="0" y="0" width="1" height="1">
<feComponentTransfer><feFuncR type="linear"/><feFuncG type="linear"/><feFuncB type="linear"/></feComponentTransfer></filter></svg>
<p><label>Exposure <input id="stops" type="range" min="-6" max="6" step="0.5" value="0"></label> <output id="stopped">0</output> stops</p>
<p><label>A <select id="a"></select></label> <label>B <select id="b"></select></label> <button id="flip">Flip (F)</button></p>
<figure><img id="shown" class="picture" alt="A or B"><figcaption id="which"></figcaption></figure>
)";

constexpr const char* kPictureScript = R"(
const id=n=>document.getElementById(n),pictures=[...document.querySelectorAll('.picture[data-name]')];
let side='a';
function show(){const p=pictures[id(side).value];id('shown').src=p.src;id('which').textContent=side.toUpperCase()+': '+p.dataset.name}
function flip(){side=side=='a'?'b':'a';show()}
function expose(){const s=+id('stops').value;id('stopped').textContent=s;
document.querySelectorAll('#exposure feComponentTransfer *').forEach(f=>f.setAttribute('slope',white*2**s))}
for(const s of ['a','b']){pictures.forEach((p,i)=>id(s).add(new Option(p.dataset.name,i)));id(s).onchange=()=>{side=s;show()}}
id('b').selectedIndex=Math.min(1,pictures.length-1);
id('flip').onclick=id('shown').onclick=flip;id('stops').oninput=expose;
document.addEventListener('keydown',e=>{if(e.key=='f'&&!e.ctrlKey)flip()});
expose();show();
)";

std::string base64(const std::string& bytes) {
  constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t group = 0;
    for (size_t k = 0; k < 3; ++k)
      group = group << 8 | (i + k < bytes.size() ? static_cast<uint8_t>(bytes[i + k]) : 0U);
    for (size_t k = 0; k < 4; ++k) out += i + k <= bytes.size() ? kDigits[group >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

}  // namespace

void Markup::openPage(const std::string& title, const std::string& heading, const std::string& style) {
  put("<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width, initial-scale=1\">\n");
  put("<title>{}</title><style>{}{}</style></head><body>\n<h1>{}</h1>\n", escapeXml(title), kPageStyle, style,
      escapeXml(heading));
}

std::string pictureTools(float white) {
  return fmt::format("{}<script>addEventListener('DOMContentLoaded',()=>{{const white={};{}}})</script>\n",
                     kPictureTools, white, kPictureScript);
}

std::string embedded(const std::string& png) {
  std::ifstream file(png, std::ios::binary);
  return "data:image/png;base64," + base64({std::istreambuf_iterator<char>(file), {}});
}

std::string percent(double share) { return shortNumber(100 * share) + " %"; }
std::string megabytes(double bytes) { return fmt::format("{:.0f} MB", bytes / 1048576); }

}  // namespace tomales
