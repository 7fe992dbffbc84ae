// Typed parameters of a shader, and the shader as the renderer sees it. Part of reyes/shader.h.
#pragma once
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "reyes/shader/math.h"
#include "reyes/shader_api.h"

namespace rsl {

/// A declared parameter. Define one of the typed classes below at namespace scope, and list it in a Shader of the same
/// file. With a role (TmRole) the renderer uses its value too, whatever its name is.
class Param {
 public:
  Param(const char* name, int32_t type, std::vector<float> floats, std::vector<const char*> strings, const char* doc,
        TmRole role = TM_ROLE_NONE, int length = 1)
      : floats_(std::move(floats)),
        strings_(std::move(strings)),
        decl_{name, type, length, floats_.data(), strings_.data(), doc, role} {}
  Param(const Param&) = delete;

 protected:
  const TmValue& value(const TmGrid* g) const { return g->params[index_]; }

 private:
  friend class Shader;
  TM_OF_THIS_PLUGIN friend const char* faultOfParameters();
  std::vector<float> floats_;
  std::vector<const char*> strings_;
  TmParamDecl decl_;
  int place_ = 0, index_ = 0;  // place_ is that in shaders' lists, the same in all; index_ is that in TmGrid::params
  std::vector<const TmShader*> listedBy_;
  Param* const older_ = std::exchange(newest(), this);

  TM_OF_THIS_PLUGIN static Param*& newest() {
    static Param* param = nullptr;
    return param;
  }
};

/// Returns TmShaderLibrary::fault: null, or a sentence about a parameter that no shader lists and that would have no
/// value.
TM_OF_THIS_PLUGIN inline const char* faultOfParameters() {
  static std::string fault;
  for (const Param* p = Param::newest(); p; p = p->older_)
    if (p->listedBy_.empty())
      fault = std::string("no shader lists the parameter \"") + p->decl_.name + "\", which would have no value";
  return fault.empty() ? nullptr : fault.c_str();
}

class FloatParam : public Param {
 public:
  FloatParam(const char* name, float value, const char* doc, TmRole role = TM_ROLE_NONE)
      : Param(name, TM_FLOAT, {value}, {}, doc, role) {}
  /// Tells whether all points of the batch have one value, as all other batches of the object then have.
  bool isUniform(const TmGrid* g) const { return value(g).step == 0; }
  float operator()(const TmGrid* g, int i) const {
    const TmValue& v = value(g);
    return v.c[0][i * v.step];
  }
};

/// A number that is the same at all points, like RSL's `uniform`: primitive variables do not override it.
class UniformFloatParam : public Param {
 public:
  UniformFloatParam(const char* name, float value, const char* doc, TmRole role = TM_ROLE_NONE)
      : Param(name, TM_FLOAT | TM_UNIFORM, {value}, {}, doc, role) {}
  float operator()(const TmGrid* g) const { return value(g).c[0][0]; }
};

template <TmType type>
class TripleParam : public Param {
 public:
  TripleParam(const char* name, Vec3 v, const char* doc, TmRole role = TM_ROLE_NONE)
      : Param(name, type, {v.x, v.y, v.z}, {}, doc, role) {}
  Vec3 operator()(const TmGrid* g, int i) const {
    const TmValue& v = this->value(g);
    return {v.c[0][i * v.step], v.c[1][i * v.step], v.c[2][i * v.step]};
  }
};
using ColorParam = TripleParam<TM_COLOR>;
using PointParam = TripleParam<TM_POINT>;
using VectorParam = TripleParam<TM_VECTOR>;
using NormalParam = TripleParam<TM_NORMAL>;

class StringParam : public Param {
 public:
  StringParam(const char* name, const char* value, const char* doc, TmRole role = TM_ROLE_NONE)
      : Param(name, TM_STRING, {}, {value}, doc, role) {}
  const char* operator()(const TmGrid* g) const { return value(g).string; }
};

// Arrays are uniform and have the length that is declared: p(g, element).

class FloatArrayParam : public Param {
 public:
  FloatArrayParam(const char* name, const std::vector<float>& values, const char* doc)
      : FloatArrayParam(name, values, int(values.size()), doc) {}
  float operator()(const TmGrid* g, int element) const { return value(g).c[0][element]; }
  int length(const TmGrid* g) const { return value(g).length; }

 private:
  FloatArrayParam(const char* name, const std::vector<float>& values, int length, const char* doc)
      : Param(name, TM_FLOAT, values, {}, doc, TM_ROLE_NONE, length) {}
};

template <TmType type>
class TripleArrayParam : public Param {
 public:
  TripleArrayParam(const char* name, const std::vector<Vec3>& values, const char* doc)
      : Param(name, type, flat(values), {}, doc, TM_ROLE_NONE, static_cast<int>(values.size())) {}
  Vec3 operator()(const TmGrid* g, int element) const {
    const TmValue& v = this->value(g);
    return {v.c[0][3 * element], v.c[1][3 * element], v.c[2][3 * element]};
  }
  int length(const TmGrid* g) const { return this->value(g).length; }

 private:
  static std::vector<float> flat(const std::vector<Vec3>& values) {
    std::vector<float> out;
    for (const Vec3& v : values) out.insert(out.end(), {v.x, v.y, v.z});
    return out;
  }
};
using ColorArrayParam = TripleArrayParam<TM_COLOR>;
using PointArrayParam = TripleArrayParam<TM_POINT>;

class StringArrayParam : public Param {
 public:
  StringArrayParam(const char* name, const std::vector<const char*>& values, const char* doc)
      : Param(name, TM_STRING, {}, values, doc, TM_ROLE_NONE, static_cast<int>(values.size())) {}
  const char* operator()(const TmGrid* g, int element) const {
    const char* s = value(g).string;
    while (element-- > 0) s += std::char_traits<char>::length(s) + 1;
    return s;
  }
  int length(const TmGrid* g) const { return value(g).length; }
};

/// A matrix, the identity unless given: 16 floats in RenderMan's order, from shader to current space, which Matrix::of
/// (reyes/shader/shadeops.h) takes.
class MatrixParam : public Param {
 public:
  MatrixParam(const char* name, const char* doc)
      : Param(name, TM_MATRIX, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, {}, doc) {}
  const float* operator()(const TmGrid* g) const { return value(g).c[0]; }
};

/// An output parameter. It is stored only if a Display asks for its name; otherwise wanted() is false, and it need not
/// be computed.
template <int32_t type, class T>
class Output : public Param {
 public:
  Output(const char* name, const char* doc, TmRole role = TM_ROLE_NONE)
      : Param(name, type | TM_OUTPUT, {0, 0, 0}, {}, doc, role) {}
  bool wanted(const TmGrid* g) const { return value(g).step == 1; }
  /// Call it only if wanted().
  void set(const TmGrid* g, int i, const T& v) const {
    const float* from = reinterpret_cast<const float*>(&v);
    for (size_t k = 0; k < (type == TM_FLOAT ? 1 : 3); ++k) const_cast<float*>(value(g).c[k])[i] = from[k];
  }
};
using FloatOutput = Output<TM_FLOAT, float>;
using ColorOutput = Output<TM_COLOR, Color>;
using PointOutput = Output<TM_POINT, Vec3>;
using VectorOutput = Output<TM_VECTOR, Vec3>;
using NormalOutput = Output<TM_NORMAL, Vec3>;

/// A shader for the renderer. It lists every parameter that it reads. Shaders that share a parameter list it at the
/// same place.
class Shader {
 public:
  Shader(TmKind kind, const char* name, const char* doc, uint32_t capabilities, void (*shade)(const TmGrid*),
         const std::vector<Param*>& params) {
    shader_.abi = TM_SHADER_ABI;
    shader_.structBytes = sizeof shader_;
    shader_.kind = kind;
    shader_.capabilities = capabilities;
    shader_.paramBytes = sizeof(TmParamDecl);
    shader_.shade = shade;
    shader_.name = name;
    shader_.doc = doc;
    shader_.unlist = unlist;
    for (Param* p : params) list(*p);
    shader_.paramCount = static_cast<int32_t>(decls_.size());
    shader_.params = decls_.data();
    shader_.fault = fault_.empty() ? nullptr : fault_.c_str();
  }
  Shader(const Shader&) = delete;
  operator const TmShader*() const { return &shader_; }

 private:
  void list(Param& p) {
    const int place = static_cast<int>(decls_.size());
    if (!p.listedBy_.empty() && p.place_ != place)
      fault_ = std::string("lists the parameter \"") + p.decl_.name + "\" at place " + std::to_string(place + 1) +
               ", and shader \"" + p.listedBy_.back()->name + "\" lists it at place " + std::to_string(p.place_ + 1) +
               ": give each a parameter of its own";
    p.place_ = p.index_ = place;
    p.listedBy_.push_back(&shader_);
    decls_.push_back(p.decl_);
  }
  /// Implements TmShader::unlist.
  static const char* unlist(const TmShader* shader, int32_t k) {
    const char* name = nullptr;
    for (Param* p = Param::newest(); p; p = p->older_) {
      if (std::find(p->listedBy_.begin(), p->listedBy_.end(), shader) != p->listedBy_.end()) continue;
      const bool chosen = k-- == 0;
      if (chosen) name = p->decl_.name;
      p->index_ = chosen ? shader->paramCount : p->place_;
    }
    return name;
  }
  std::vector<TmParamDecl> decls_;
  std::string fault_;
  TmShader shader_{};
};

template <size_t count>
TmShaderLibrary libraryOf(const TmShader* const (&shaders)[count], const char* fault = nullptr) {
  TmShaderLibrary library{};
  library.abi = TM_SHADER_ABI;
  library.structBytes = sizeof library;
  library.shaders = shaders;
  library.fault = fault;
  library.count = static_cast<int32_t>(count);
  return library;
}

}  // namespace rsl
